//! sph-core on a workstation: allocation, threads, files, pictures.

pub mod output;
pub mod picture;
