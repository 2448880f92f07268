//! What all targets share.

/// Keeps all work on one thread: faster for small inputs, and the same coverage every time.
pub fn init() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    pool.build_global().expect("nothing has used the threads before");
}

/// Feeds the target of that name.
pub fn run(name: &str, bytes: &[u8]) {
    (osculate_fuzzing::target(name).run)(bytes);
}
