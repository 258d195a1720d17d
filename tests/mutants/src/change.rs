//! One change of a source file, and the text of a file in which every change waits behind its number.

use std::fmt::Write as _;
use std::ops::Range;

/// One change: what stands at `range` becomes `text`; where `range` is empty, `text` is put in.
#[derive(Clone, Debug)]
pub(crate) struct Change {
    /// Its number, from 1; 0 is no change.
    pub(crate) number: u32,
    /// The file below the folder of the sources.
    pub(crate) file: String,
    /// The line in the file, from 1.
    pub(crate) line: usize,
    /// The function that it is in, with the type where it has one.
    pub(crate) function: String,
    /// Bytes of the file.
    pub(crate) range: Range<usize>,
    /// What it was, on one line.
    pub(crate) before: String,
    /// What it becomes.
    pub(crate) text: String,
    /// How the crate is called there: `crate`, in a macro `$crate`.
    pub(crate) root: &'static str,
}

impl Change {
    /// What the list of equal changes calls it: file, function and the change.
    pub(crate) fn name(&self) -> String {
        let text = one_line(&self.text);
        format!("{}\t{}\t{} → {}", self.file, self.function, self.before, text)
    }
}

/// The text with each run of white space as one space.
pub(crate) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The file's text with all its changes, each behind `active(number)`. What a change puts in stands between two comments, by which
/// an error of the compiler finds it.
pub(crate) fn with_switches(source: &str, changes: &[Change]) -> String {
    let mut sorted: Vec<&Change> = changes.iter().collect();
    sorted.sort_by_key(|change| (change.range.start, usize::MAX - change.range.end, change.number));
    let mut text = String::with_capacity(2 * source.len());
    emit(source, 0..source.len(), &sorted, &mut text);
    text
}

/// Writes a part of the source; all of `changes` lie in it.
fn emit(source: &str, part: Range<usize>, mut changes: &[&Change], text: &mut String) {
    let mut at = part.start;
    while let [first, ..] = changes {
        let range = first.range.clone();
        text.push_str(&source[at..range.start]);
        let alike = changes.iter().take_while(|change| change.range == range).count();
        let within = changes[alike..].iter().take_while(|change| change.range.end <= range.end).count();
        let (these, rest) = changes.split_at(alike);
        let within = if range.is_empty() { 0 } else { within };
        if range.is_empty() {
            these.iter().for_each(|change| switch(change, text));
        } else {
            text.push('(');
            for change in these {
                switch(change, text);
                text.push_str(" else ");
            }
            text.push('{');
            emit(source, range.clone(), &rest[..within], text);
            text.push_str("})");
        }
        changes = &rest[within..];
        at = range.end;
    }
    text.push_str(&source[at..part.end]);
}

/// `if active(7) { … }`
fn switch(change: &Change, text: &mut String) {
    let Change { root, number, text: changed, .. } = change;
    write!(text, "if {root}::mutants::active({number}) {{ /*<{number}>*/{changed}/*<>*/ }}").unwrap();
}

/// The number of the change that puts in what stands at a byte of a text with switches.
pub(crate) fn blamed(text: &str, byte: usize) -> Option<u32> {
    let before = text.get(..byte)?;
    let (_, mark) = before.rsplit_once("/*<")?;
    let (number, _) = mark.split_once(">*/")?;
    number.parse().ok()
}

/// The numbers of all changes on the line at a byte.
pub(crate) fn on_the_line(text: &str, byte: usize) -> Vec<u32> {
    let start = text[..byte].rfind('\n').map_or(0, |at| at + 1);
    let end = text[byte..].find('\n').map_or(text.len(), |at| byte + at);
    text[start..end].split("/*<").filter_map(|rest| rest.split_once(">*/")?.0.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(number: u32, range: Range<usize>, text: &str) -> Change {
        let (file, function, before) = Default::default();
        Change { number, file, line: 1, function, range, before, text: text.into(), root: "crate" }
    }

    #[test]
    fn a_change_in_a_change_is_behind_both_switches() {
        let source = "a + b * c";
        let changes = [change(1, 0..9, "a - b * c"), change(2, 4..9, "b / c")];
        let text = with_switches(source, &changes);
        let inner = "(if crate::mutants::active(2) { /*<2>*/b / c/*<>*/ } else {b * c})";
        let outer = "(if crate::mutants::active(1) { /*<1>*/a - b * c/*<>*/ } else {a + ";
        assert_eq!(text, format!("{outer}{inner}}})"));
        assert_eq!(blamed(&text, text.find("b / c").unwrap()), Some(2));
        assert_eq!(blamed(&text, text.find("b * c}").unwrap()), None);
        assert_eq!(on_the_line(&text, 3), [1, 2]);
    }

    #[test]
    fn two_changes_of_one_expression_are_one_choice() {
        let text = with_switches("a < b", &[change(1, 0..5, "a <= b"), change(2, 0..5, "a > b")]);
        assert_eq!(text.matches("else if").count(), 1);
        assert!(text.ends_with("else {a < b})"));
    }

    #[test]
    fn what_is_put_in_leaves_what_was_there() {
        let text = with_switches("{ a }", &[change(4, 1..1, "return 0;")]);
        assert_eq!(text, "{if crate::mutants::active(4) { /*<4>*/return 0;/*<>*/ } a }");
    }
}
