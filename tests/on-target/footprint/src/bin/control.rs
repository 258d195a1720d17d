//! The negative control: an index that is not checked before use can panic, and the check must find that.
#![no_std]
#![no_main]

use fluisim_footprint::typical::Gridded;

fluisim_footprint::firmware!(Gridded<f32>, |_: &mut Gridded<f32>| {
    let table = core::hint::black_box([1_u8, 2, 3]);
    table[core::hint::black_box(1_usize)]
});
