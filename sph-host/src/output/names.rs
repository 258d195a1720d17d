//! Names for formats that take letters, digits and `_` alone.

use super::Column;

/// The names of columns with `_` for what is no letter of A to Z, digit or `_`. Where one is taken already, by another column or by the
/// format itself, more of `_` follow.
pub(super) fn plain_names(columns: &[Column], taken_by_format: &[&str]) -> Vec<String> {
    let mut names: Vec<String> = Vec::with_capacity(columns.len());
    // a name that needs no change keeps it, whatever comes before it
    let is_kept = |name: &str| plain(name) == name && !taken_by_format.contains(&name);
    for column in columns {
        let mut name = plain(&column.name);
        let is_taken = |name: &String| {
            taken_by_format.contains(&name.as_str())
                || names.contains(name)
                || columns.iter().any(|other| other.name == *name && is_kept(name))
        };
        while !is_kept(&column.name) && is_taken(&name) {
            name.push('_');
        }
        names.push(name);
    }
    names
}

fn plain(name: &str) -> String {
    name.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '_' }).collect()
}

/// One line of text in ASCII, for a comment.
pub(super) fn comment(text: &str) -> String {
    let plain: String =
        text.chars().map(|letter| if letter.is_ascii_graphic() { letter } else { ' ' }).collect();
    plain.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain_and_differ() {
        let columns =
            ["a b", "a_b", "x", "a/b", "é", "_", "velocity_x"].map(|name| Column::new(name, Vec::new()));
        let names = plain_names(&columns, &["x"]);
        assert_eq!(names, ["a_b_", "a_b", "x_", "a_b__", "__", "_", "velocity_x"]);
    }
}
