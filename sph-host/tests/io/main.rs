//! Particle files: read back what was written; files at fault, and what every error says.

mod bgeo;
mod bombs;
mod damage;

mod hdf5;
mod hdf5_damage;
mod npy;
mod parted;
mod ply;
mod round_trip;
mod support;
mod unused;
mod words;
mod xyz;
