//! Values made when they are first asked for.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Values by key. Each is made once, by the first thread that asks; others that want the same one wait for it, and those that
/// want another one do not.
pub(crate) struct Memo<K, V> {
    cells: Mutex<HashMap<K, Arc<Cell<V>>>>,
}

/// A value, or none yet. Locked while it is made.
type Cell<V> = Mutex<Option<V>>;

impl<K: Hash + Eq, V: Clone> Memo<K, V> {
    /// The value of `key`, made if it is not there yet. A failure is not kept: the next one who asks tries again.
    pub(crate) fn get_or_make<E>(&self, key: K, make: impl FnOnce() -> Result<V, E>) -> Result<V, E> {
        let cell = Arc::clone(lock(&self.cells).entry(key).or_default());
        let mut value = lock(&cell);
        if let Some(value) = value.as_ref() {
            return Ok(value.clone());
        }
        Ok(value.insert(make()?).clone())
    }

    /// Whether the value of `key` is there or being made.
    pub(crate) fn has(&self, key: &K) -> bool {
        let cell = lock(&self.cells).get(key).map(Arc::clone);
        cell.is_some_and(|cell| cell.try_lock().map_or(true, |value| value.is_some()))
    }

    /// All values that are there, in no order.
    pub(crate) fn values(&self) -> Vec<V> {
        let cells: Vec<_> = lock(&self.cells).values().map(Arc::clone).collect();
        cells.iter().filter_map(|cell| lock(cell).clone()).collect()
    }
}

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self { cells: Mutex::default() }
    }
}

/// After a panic elsewhere the content is still right: a value is put in place whole.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;
    use std::sync::Barrier;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;
    use std::time::Duration;

    #[test]
    fn threads_that_ask_at_once_share_one_value() {
        let (memo, made, start) = (Memo::<&str, usize>::default(), AtomicUsize::new(0), Barrier::new(8));
        let ask = || {
            start.wait();
            memo.get_or_make("key", || {
                thread::sleep(Duration::from_millis(20));
                Ok::<_, Infallible>(made.fetch_add(1, Ordering::Relaxed))
            })
        };
        thread::scope(|scope| {
            let threads: Vec<_> = (0..8).map(|_| scope.spawn(ask)).collect();
            threads.into_iter().for_each(|thread| assert_eq!(thread.join().unwrap(), Ok(0)));
        });
        assert_eq!(made.into_inner(), 1);
    }

    /// Were values made under one lock, these two would wait for each other for ever.
    #[test]
    fn different_values_are_made_at_the_same_time() {
        let (memo, both) = (Memo::<u32, u32>::default(), Barrier::new(2));
        thread::scope(|scope| {
            for key in 0..2 {
                let (memo, both) = (&memo, &both);
                scope.spawn(move || {
                    let make = || {
                        both.wait();
                        Ok::<_, Infallible>(10 * key)
                    };
                    assert_eq!(memo.get_or_make(key, make), Ok(10 * key));
                });
            }
        });
        let mut values = memo.values();
        values.sort_unstable();
        assert_eq!(values, [0, 10]);
    }

    #[test]
    fn failures_are_not_kept() {
        let memo = Memo::<(), u32>::default();
        assert!(!memo.has(&()));
        assert_eq!(memo.get_or_make((), || Err("no")), Err("no"));
        assert!(!memo.has(&()) && memo.values().is_empty());
        assert_eq!(memo.get_or_make((), || Ok::<_, &str>(7)), Ok(7));
        assert!(memo.has(&()));
        assert_eq!(memo.get_or_make((), || Err("not asked any more")), Ok(7));
    }
}
