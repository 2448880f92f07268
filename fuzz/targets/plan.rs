#![no_main]

mod common;

libfuzzer_sys::fuzz_target!(init: common::init(), |bytes: &[u8]| common::run("plan", bytes));
