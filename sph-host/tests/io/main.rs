//! Particle files: files at fault, and what every error says.

mod damage;
mod support;
mod unused;
mod words;
