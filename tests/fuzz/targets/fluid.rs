//! `fluisim_fuzz::fluid` with the inputs of libFuzzer.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| fluisim_fuzz::fluid(data));
