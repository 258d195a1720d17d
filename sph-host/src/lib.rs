//! sph-core on a workstation: allocation, threads, files, pictures.

pub mod io;
pub mod output;
pub mod picture;
