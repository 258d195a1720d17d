//! The incompressible solver: its operators, what it keeps, and each trap that such a solver can fall into.

mod operators;
mod rest;
mod solution;
mod support;
