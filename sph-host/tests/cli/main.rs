//! The command `fluisim` from outside: what is promised of `sample` and `kernels`, sentence by sentence.

mod chunks;
mod columns;
mod csv_files;
mod data_errors;
mod fast;
mod file_faults;
mod files;
mod firmware;
mod grids;
mod install;
mod kernels;
mod numbers;
mod oracle;
mod planes;
mod process;
mod refusals;
mod scalars;
mod study;
mod support;
mod surfaces;
mod units;
mod words;
