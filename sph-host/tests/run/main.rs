//! `fluisim run` from outside: what is promised of it, sentence by sentence, at resolutions that take no time.

#[path = "../cli/support.rs"]
#[allow(dead_code)] // shared with the tests of `sample`
mod support;

mod again;
mod damage;
mod files;
mod incompressible;
mod kills;
mod pbf;
mod process;
mod words;
