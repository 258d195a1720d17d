//! Nothing: cargo builds `core` for a target when it builds a crate for it, and this is the smallest.
#![no_std]
