//! Every neighbour search finds the same neighbours, bit for bit: [`oracle`] says which, in plain nested loops; [`plan`]
//! invents configurations that sit on cell boundaries, on the radius and on the ends of periods.

mod agreement;
mod directed;
mod errors;
mod extremes;
mod oracle;
mod plan;
mod sweep;
