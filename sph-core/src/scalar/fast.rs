//! `Fast32`.
