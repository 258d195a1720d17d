//! sph-core on a workstation: allocation, threads, files, pictures.
