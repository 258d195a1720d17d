//! Numbers for people.

/// A number for people, to a few significant digits whatever its size.
pub(crate) struct Significant(pub(crate) f64);

impl std::fmt::Display for Significant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = f.precision().unwrap_or(3);
        let rounded: f64 = format!("{:.*e}", digits - 1, self.0).parse().unwrap_or(self.0);
        write!(f, "{rounded}")
    }
}
