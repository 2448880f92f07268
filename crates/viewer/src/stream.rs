//! Frames of a sequence, read on a thread of their own while it plays.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use glam::DVec3;
use osculate_cage::Sequence;

/// What is read for the window. The thread ends, after the frame that it reads, when this is dropped.
pub(crate) struct Stream {
    sequence: Arc<Sequence>,
    desk: Arc<Desk>,
    /// The time that was asked for last.
    asked: Option<f64>,
}

/// What window and thread share.
#[derive(Default)]
struct Desk {
    order: Mutex<Order>,
    changed: Condvar,
}

#[derive(Default)]
struct Order {
    /// Seconds from the first frame. A newer time takes the place of one that was not begun.
    time: Option<f64>,
    is_over: bool,
}

impl Stream {
    /// Starts the thread. `tell` is called from there with the positions at each time that was asked for, or what is wrong.
    pub(crate) fn start(
        sequence: &Arc<Sequence>,
        tell: impl Fn(Result<Vec<DVec3>, String>) + Send + 'static,
    ) -> std::io::Result<Self> {
        let stream = Self { sequence: Arc::clone(sequence), desk: Arc::default(), asked: None };
        let (desk, frames) = (Arc::clone(&stream.desk), Arc::clone(sequence));
        let read = move || {
            while let Some(time) = desk.next() {
                tell(frames.positions_at(frames.times()[0] + time).map_err(|error| error.to_string()));
            }
        };
        std::thread::Builder::new().name("stream".to_owned()).spawn(read)?;
        Ok(stream)
    }

    /// Whether this reads the frames of a sequence.
    pub(crate) fn is_of(&self, sequence: &Arc<Sequence>) -> bool {
        Arc::ptr_eq(&self.sequence, sequence)
    }

    /// Asks for the positions at a time, in seconds from the first frame, unless they were asked for last.
    pub(crate) fn ask(&mut self, time: f64) {
        if self.asked.replace(time) != Some(time) {
            self.desk.lock().time = Some(time);
            self.desk.changed.notify_one();
        }
    }

    /// Forgets what was asked for: it will be asked for again.
    pub(crate) fn forget(&mut self) {
        self.asked = None;
    }
}

impl Drop for Stream {
    fn drop(&mut self) {
        self.desk.lock().is_over = true;
        self.desk.changed.notify_one();
    }
}

impl Desk {
    fn lock(&self) -> MutexGuard<'_, Order> {
        // An order is right at any moment.
        self.order.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for the next time; none at the end.
    fn next(&self) -> Option<f64> {
        let mut order = self.lock();
        while order.time.is_none() && !order.is_over {
            order = self.changed.wait(order).unwrap_or_else(PoisonError::into_inner);
        }
        order.time.take().filter(|_| !order.is_over)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use osculate_cage::ReadDesc;
    use std::sync::mpsc::channel;

    #[test]
    fn positions_come_in_the_order_of_the_times() {
        let folder = tempfile::tempdir().unwrap();
        for (k, z) in [0.0, 2.0, 4.0].iter().enumerate() {
            let text = format!("v 0 0 {z}\nv 1 0 {z}\nv 1 1 {z}\nv 0 1 {z}\nf 1 2 3 4\n");
            std::fs::write(folder.path().join(format!("f_{k}.obj")), text).unwrap();
        }
        let pattern = folder.path().join("f_%d.obj");
        let sequence = Sequence::open(&pattern, &ReadDesc::default()).unwrap().with_frames_per_second(1.0);
        let sequence = Arc::new(sequence);
        let (sender, received) = channel();
        let mut stream = Stream::start(&sequence, move |positions| sender.send(positions).unwrap()).unwrap();
        assert!(stream.is_of(&sequence));
        for (time, z) in [(0.5, 1.0), (1.75, 3.5), (9.0, 4.0)] {
            stream.ask(time);
            assert_eq!(received.recv().unwrap().unwrap()[0].z, z);
        }
        // The same again is not read again.
        stream.ask(9.0);
        stream.forget();
        std::fs::remove_file(folder.path().join("f_2.obj")).unwrap();
        stream.ask(9.0);
        assert!(received.recv().unwrap().unwrap_err().contains("f_2.obj"));
        drop(stream);
        assert!(received.recv().is_err(), "the thread has ended");
    }
}
