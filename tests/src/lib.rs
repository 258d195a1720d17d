//! Integration tests live in `tests/`; the README's example is tested here.

#[doc = include_str!("../../README.md")]
pub struct Readme;
