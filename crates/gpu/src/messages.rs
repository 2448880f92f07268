//! The messages of the validation layers, collected for tests and for `--validation`.

use std::{
    ffi::{CStr, c_void},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use ash::vk;

/// Messages that are not defects of the program, each by a part of its identifier.
///
/// * `OutputNotConsumed`: a stage writes an output that the next stage does not read. One vertex stage serves pipelines with
///   and without a fragment stage, and outputs that only transform feedback reads are reported as well.
const ALLOWED: [&str; 1] = ["OutputNotConsumed"];

/// So many messages are kept; a loop that errs in every frame must not fill the memory.
const CAPACITY: usize = 1000;

/// The messages so far; clones share one list, and it outlives the device, so that complaints about leaked objects are seen.
#[derive(Clone, Debug, Default)]
pub struct MessageLog(Arc<Messages>);

#[derive(Debug, Default)]
struct Messages(Mutex<Vec<String>>);

impl MessageLog {
    /// All messages so far, oldest first: warnings and errors of the validation layers. Empty without validation.
    pub fn all(&self) -> Vec<String> {
        self.0.lock().clone()
    }

    /// Creation parameters of a messenger that writes to this log. A clone of the log must outlive the messenger.
    pub(crate) fn messenger_info(&self) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
        vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
            )
            .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
            .pfn_user_callback(Some(callback))
            .user_data(Arc::as_ptr(&self.0).cast_mut().cast())
    }
}

impl Messages {
    /// Keeps one message, and the name of the pass it is about, unless it is allowed or the log is full.
    fn push(&self, pass: &str, id: &str, text: &str) {
        if ALLOWED.iter().any(|allowed| id.contains(allowed)) {
            return;
        }
        let mut messages = self.lock();
        if messages.len() < CAPACITY {
            let place = if pass.is_empty() { String::new() } else { format!("in {pass:?}: ") };
            messages.push(format!("{place}{id}: {text}"));
        }
    }

    /// The list, also after a panic elsewhere: `push` cannot leave a `Vec` of `String` half changed.
    fn lock(&self) -> MutexGuard<'_, Vec<String>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Called by the layers, on any thread; must not panic, and does not: it formats, locks without unwrapping, and pushes.
unsafe extern "system" fn callback(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: `messenger_info` made the pointer from a log that outlives the messenger; the layers pass a valid structure,
    // alive during the call, or null.
    let (log, data) = unsafe { (user_data.cast_const().cast::<Messages>().as_ref(), data.as_ref()) };
    if let (Some(log), Some(data)) = (log, data) {
        // SAFETY: both strings are null or end with a NUL, and live during the call, as the labels do.
        let (id, text, label) = unsafe { (text(data.p_message_id_name), text(data.p_message), label(data)) };
        log.push(&label, &id, &text);
    }
    vk::FALSE
}

/// The innermost label that stands around the command that a message is about; empty if there is none.
///
/// # Safety
/// `data` comes from the layers.
unsafe fn label(data: &vk::DebugUtilsMessengerCallbackDataEXT<'_>) -> String {
    if data.cmd_buf_label_count == 0 || data.p_cmd_buf_labels.is_null() {
        return String::new();
    }
    // SAFETY: so many labels lie there, the latest first, each with a string that ends with a NUL.
    unsafe { text((*data.p_cmd_buf_labels).p_label_name) }
}

/// The string at `pointer`, empty for null.
///
/// # Safety
/// `pointer` is null or points to a string that ends with a NUL.
unsafe fn text(pointer: *const std::ffi::c_char) -> String {
    if pointer.is_null() {
        return String::new();
    }
    // SAFETY: not null, and the caller vouches for the rest.
    unsafe { CStr::from_ptr(pointer) }.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn allowed_messages_are_dropped_and_others_kept() {
        let log = MessageLog::default();
        log.0.push("", "UNASSIGNED-CoreValidation-Shader-OutputNotConsumed", "noise");
        log.0.push("picture", "VUID-vkCmdDraw-None-02697", "not bound");
        assert_eq!(log.all(), ["in \"picture\": VUID-vkCmdDraw-None-02697: not bound"]);
    }

    #[test]
    fn the_log_does_not_grow_without_bound() {
        let log = MessageLog::default();
        (0..CAPACITY + 5).for_each(|i| log.0.push("", "id", &i.to_string()));
        assert_eq!(log.all().len(), CAPACITY);
    }
}
