//! Any bytes: an error or a certificate, in bounded memory, and never a panic.
#![no_main]

use krawl::certificate::{Reader, Settings, verify};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(mut reader) = Reader::new(bytes) {
        while let Ok(Some(_)) = reader.next_record() {}
    }
    let _ = verify(bytes, &Settings { threads: 1 }, &mut |_| ());
});
