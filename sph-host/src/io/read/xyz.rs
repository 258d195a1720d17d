//! Atoms and particles as text: `.xyz`, plain and extended.
//!
//! The first line is the number of particles, the second a comment, then there is a line for each particle. The comment
//! of an extended file says by `Properties=name:type:width:…` what the columns are, with the types S (text), R (real),
//! I (integer) and L (T or F). Without it they are `species x y z` and further numbers. One frame is read.
//!
//! Source: the extended XYZ specification of libAtoms, github.com/libAtoms/extxyz.

use super::budget::{Budget, refuse_many, refuse_wide};
use super::bytes;
use super::text_columns::{Column, Kind, Lines, push_line, words};
use crate::io::InputFile;
use crate::io::error::{Parsed, counted, shown};
use crate::io::names::check_names;
use crate::io::rows::Rows;
use crate::io::table::PointTable;

/// The line of the comment.
const COMMENT: usize = 2;

/// Reads the frame of a file.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    parse(&bytes(&file.path)?, &file.position)
}

fn parse(bytes: &[u8], named: &[String]) -> Parsed<PointTable> {
    let mut lines = Lines::new(bytes);
    let first = lines.advance().unwrap_or_default();
    let first = first.strip_prefix(b"\xef\xbb\xbf").unwrap_or(first);
    let Some(count) = count(first) else {
        return Err(lines.problem(format!("{} where the number of particles is expected", shown(first))));
    };
    let comment =
        lines.advance().ok_or_else(|| lines.problem("the file ends before its comment on line 2"))?;
    let declared = properties(comment).map(|text| columns(&text)).transpose();
    let mut declared = declared.map_err(|problem| lines.problem(problem))?;
    let budget = Budget::of_file(bytes.len() as u64);
    let mut rows = Rows::lines(COMMENT);
    for row in 0..count {
        let line = lines.advance().filter(|line| !line.is_empty()).ok_or_else(|| {
            let claimed = counted(count, "particle");
            lines.problem(format!("the particles end after {row}, where line 1 has {claimed}"))
        })?;
        rows.push(row, lines.number());
        let columns = match &mut declared {
            Some(columns) => columns,
            None => declared.insert(plain(line).map_err(|problem| lines.problem(problem))?),
        };
        push_line(columns, line, lines.number(), &budget)?;
    }
    refuse_more(&mut lines, count)?;
    let columns = declared.unwrap_or_else(|| of_words(4));
    PointTable::of_arrays(columns.into_iter().map(Column::finish).collect(), rows, named)
}

/// The number that is alone on a line.
fn count(line: &[u8]) -> Option<usize> {
    std::str::from_utf8(line).ok()?.parse().ok()
}

/// Says what stands behind the last particle.
fn refuse_more(lines: &mut Lines<'_>, particles: usize) -> Parsed<()> {
    let Some(line) = lines.advance_to_words() else { return Ok(()) };
    Err(lines.problem(match count(line) {
        Some(_) => "a second frame starts here, where a file of one frame is expected".to_owned(),
        None => format!("{} behind the last of {}", shown(line), counted(particles, "particle")),
    }))
}

/// The columns of a line without a declaration.
fn plain(line: &[u8]) -> Result<Vec<Column>, String> {
    let found = words(line).count();
    if found < 4 {
        return Err(format!("{} where `species x y z` are expected", counted(found, "word")));
    }
    refuse_many(found)?;
    Ok(of_words(found))
}

/// So many columns without a declaration.
fn of_words(count: usize) -> Vec<Column> {
    let number = |name: String| Column::new(name, 1, Kind::Number);
    let known = [Column::new("species", 1, Kind::Text)].into_iter();
    let axes = ["x", "y", "z"].map(|axis| number(axis.to_owned()));
    known.chain(axes).chain((4..count).map(|index| number(format!("array_{index}")))).collect()
}

/// What the comment says of `Properties`, of which the first counts.
fn properties(comment: &[u8]) -> Option<String> {
    let mut rest = comment;
    while !rest.is_empty() {
        let (entry, tail) = rest.split_at(entry_length(rest));
        rest = tail.trim_ascii_start();
        let Some(equals) = memchr::memchr(b'=', entry) else { continue };
        if entry[..equals].eq_ignore_ascii_case(b"Properties") {
            let value = entry[equals + 1..].strip_prefix(b"\"").and_then(|value| value.strip_suffix(b"\""));
            return Some(String::from_utf8_lossy(value.unwrap_or(&entry[equals + 1..])).into_owned());
        }
    }
    None
}

/// The length of the entry that `text` starts with: up to a blank that is not between quotation marks.
fn entry_length(text: &[u8]) -> usize {
    let (mut is_quoted, mut is_escaped) = (false, false);
    let ends = |&byte: &u8| {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' if is_quoted => is_escaped = true,
            b'"' => is_quoted = !is_quoted,
            _ => return !is_quoted && byte.is_ascii_whitespace(),
        }
        false
    };
    text.iter().position(ends).unwrap_or(text.len())
}

/// The columns that the value of `Properties` declares.
fn columns(declaration: &str) -> Result<Vec<Column>, String> {
    let parts: Vec<&str> = declaration.split(':').collect();
    let (columns, rest) = parts.as_chunks::<3>();
    if columns.is_empty() || !rest.is_empty() {
        let found = shown(declaration.as_bytes());
        return Err(format!("Properties={found} where name:type:width and so on are expected"));
    }
    refuse_many(columns.len())?;
    let columns = columns.iter().map(|&[name, kind, width]| {
        let wrong = |found: &str, expected: &str| {
            Err(format!(
                "column {} has {} where {expected} is expected",
                shown(name.as_bytes()),
                shown(found.as_bytes())
            ))
        };
        let components = match width.parse() {
            Ok(components) if components > 0 => components,
            _ => return wrong(width, "a width of 1 or more"),
        };
        refuse_wide(components)?;
        let kind = match kind {
            "R" | "I" => Kind::Number,
            "L" => Kind::Truth,
            "S" => Kind::Text,
            _ => return wrong(kind, "a type S, R, I or L"),
        };
        if name.is_empty() { wrong(name, "a name") } else { Ok(Column::new(name, components, kind)) }
    });
    let columns: Vec<Column> = columns.collect::<Result<_, _>>()?;
    check_names(columns.iter().map(|column| &*column.name))?;
    Ok(columns)
}
