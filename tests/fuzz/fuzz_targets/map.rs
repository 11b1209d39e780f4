//! Fuzz target: map.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    foliar_fuzz::feed(foliar_fuzz::Kind::Map, bytes);
});
