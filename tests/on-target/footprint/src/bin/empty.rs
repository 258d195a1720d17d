//! Firmware that does nothing: what the others are compared with.
#![no_std]
#![no_main]

struct Nothing;

impl Nothing {
    const fn new() -> Self {
        Self
    }
}

fluisim_footprint::firmware!(Nothing, |_: &mut Nothing| ());
