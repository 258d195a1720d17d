//! The command `fluisim` from outside: what is promised of `sample` and `kernels`, sentence by sentence.

mod chunks;
mod columns;
mod csv_files;
mod data_errors;
mod fast;
mod file_faults;
mod files;
mod grids;
mod kernels;
mod numbers;
mod oracle;
mod process;
mod scalars;
mod support;
mod words;
