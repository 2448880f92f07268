//! What is told about what goes on.

use std::time::{Duration, Instant};

/// How long notes and errors stay.
const NOTE: Duration = Duration::from_secs(4);
const ERROR: Duration = Duration::from_secs(15);
/// Most of them at once.
const MOST: usize = 4;

/// A line that goes by itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Note {
    pub(crate) text: String,
    pub(crate) is_error: bool,
    until: Instant,
}

/// Notes, and work that is going on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Status {
    notes: Vec<Note>,
    /// What is being done, and how much of it is done, if that is known.
    pub(crate) work: Option<(String, Option<f32>)>,
}

impl Status {
    /// Tells something.
    pub(crate) fn note(&mut self, text: impl Into<String>) {
        let text = text.into();
        tracing::info!("{text}");
        self.add(text, false, NOTE);
    }

    /// Tells what went wrong.
    pub(crate) fn error(&mut self, text: impl Into<String>) {
        let text = text.into();
        tracing::error!("{text}");
        self.add(text, true, ERROR);
    }

    fn add(&mut self, text: String, is_error: bool, time: Duration) {
        self.notes.retain(|note| note.text != text);
        self.notes.push(Note { text, is_error, until: Instant::now() + time });
        let surplus = self.notes.len().saturating_sub(MOST);
        self.notes.drain(..surplus);
    }

    /// What is told now, oldest first.
    pub(crate) fn notes(&mut self, now: Instant) -> &[Note] {
        self.notes.retain(|note| note.until > now);
        &self.notes
    }

    /// When the next note goes.
    pub(crate) fn next_change(&self) -> Option<Instant> {
        self.notes.iter().map(|note| note.until).min()
    }

    /// Takes all notes away.
    pub(crate) fn dismiss(&mut self) {
        self.notes.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_go_and_the_oldest_make_room() {
        let (mut status, now) = (Status::default(), Instant::now());
        (0..6).for_each(|number| status.note(format!("note {number}")));
        status.error("note 5");
        let notes = status.notes(now);
        assert_eq!(notes.len(), MOST);
        assert!(notes[0].text == "note 2" && notes[3].is_error, "told again, a note is the newest: {notes:?}");
        assert_eq!(status.notes(now + 2 * NOTE).len(), 1);
        assert!(status.notes(now + 2 * ERROR).is_empty() && status.next_change().is_none());
    }
}
