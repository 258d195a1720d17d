//! Integration tests live in `tests/`; the examples of the READMEs are tested here.

#[doc = include_str!("../../README.md")]
pub struct Readme;

#[doc = include_str!("../../sph-core/README.md")]
pub struct CoreReadme;

#[doc = include_str!("../../sph-lab/README.md")]
pub struct LabReadme;

#[doc = include_str!("../../sph-host/README.md")]
pub struct HostReadme;
