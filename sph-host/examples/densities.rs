//! Densities of half a million particles on all cores: `cargo run --release -p sph-host --example densities`.

use std::time::Instant;

use sph_core::Uniform;
use sph_core::kernel::CubicSpline;
use sph_host::fast::SortedCells;

fn main() -> Result<(), sph_core::Error> {
    // a lattice of spacing 1, so that particles of mass 1 have density 1
    let side = 80;
    let positions: Vec<[f32; 3]> = (0..side * side * side)
        .map(|i| [i % side, i / side % side, i / side / side].map(|cell| cell as f32 + 0.5))
        .collect();

    let start = Instant::now();
    let cells = SortedCells::sort(&positions, 2.6)?; // support radius h = 2.6 spacings
    let density = cells.density::<CubicSpline>(Uniform(1.0))?;
    let seconds = start.elapsed().as_secs_f64();

    // in the order of the input; a particle in the middle has neighbours on all sides
    let middle = density[side * side * (side / 2) + side * (side / 2) + side / 2];
    println!("{} densities in {seconds:.3} s; {middle:.5} in the middle", density.len());
    assert!((middle - 1.0).abs() < 0.01);
    Ok(())
}
