//! The Stanford polygon format: `.ply`, as text and binary in either order of bytes.
//!
//! The points are the element `vertex`. Other elements before it are passed over, those behind it are not looked at.
//! Source: Greg Turk, *The PLY Polygon File Format*, 1994.

use super::budget::Budget;
use super::bytes;
use super::fields::{Field, columns};
use super::ply_header::{Coding, Element, Form, Header, Property};
use super::text_columns::{Column, Kind, Lines, push_line, words};
use crate::io::InputFile;
use crate::io::error::{Parsed, Problem, counted, shown};
use crate::io::names::check_names;
use crate::io::numbers::{Endian, Stored};
use crate::io::rows::Rows;
use crate::io::table::{Array, PointTable, Unusable};

/// Reads the vertices of a file.
pub(super) fn read(file: &InputFile) -> Parsed<PointTable> {
    parse(&bytes(&file.path)?, &file.position)
}

fn parse(bytes: &[u8], named: &[String]) -> Parsed<PointTable> {
    let mut lines = Lines::new(bytes);
    let Header { coding, elements } = Header::read(&mut lines)?;
    let (before, vertex) = split(&elements)?;
    let budget = Budget::of_file(bytes.len() as u64);
    let (arrays, rows) = match coding {
        Coding::Text => text(before, vertex, lines, &budget)?,
        Coding::Binary(endian) => (binary(before, vertex, lines.rest(), endian, &budget)?, Rows::points()),
    };
    PointTable::of_arrays(arrays, rows, named).map_err(|problem| problem.or_at(&vertex.place()))
}

/// The elements before the vertices, and the vertices, which have coordinates.
fn split(elements: &[Element]) -> Parsed<(&[Element], &Element)> {
    let names = |names: Vec<&str>| match names.len() {
        0 => "none at all".to_owned(),
        _ => names.iter().map(|name| shown(name.as_bytes())).collect::<Vec<_>>().join(", "),
    };
    let Some(index) = elements.iter().position(|element| element.name == "vertex") else {
        let found = names(elements.iter().map(|element| &*element.name).collect());
        return Err(Problem::new(format!("no element is called `vertex`; there are {found}")));
    };
    let vertex = &elements[index];
    if let Some(second) = elements[index + 1..].iter().find(|element| element.name == "vertex") {
        return Err(Problem::at(second.place(), "a second element `vertex`"));
    }
    let properties = || vertex.properties.iter().map(|property| &*property.name);
    check_names(properties()).map_err(|problem| Problem::at(vertex.place(), problem))?;
    Ok((&elements[..index], vertex))
}

impl Element {
    /// Where the element is declared, for messages.
    fn place(&self) -> String {
        format!("line {}, element {}", self.line, shown(self.name.as_bytes()))
    }

    /// That the data end within the element.
    fn cut_short(&self, there: usize) -> Problem {
        let claimed = counted(self.count, "line");
        Problem::at(self.place(), format!("the data end after {there} of {claimed}"))
    }
}

impl Property {
    /// The array of a list, which nothing can use.
    fn unusable(&self) -> Array {
        Array::unusable(&*self.name, Unusable::other("a list a point, where one number is expected"))
    }
}

/// The vertices of a text, a line each.
fn text(
    before: &[Element],
    vertex: &Element,
    mut lines: Lines<'_>,
    budget: &Budget,
) -> Parsed<(Vec<Array>, Rows)> {
    for element in before.iter().filter(|element| !element.properties.is_empty()) {
        for index in 0..element.count {
            lines.advance_to_words().ok_or_else(|| element.cut_short(index))?;
        }
    }
    let has_lists = vertex.length().is_none();
    let mut columns: Vec<Column> =
        vertex.properties.iter().map(|property| Column::new(&*property.name, 1, Kind::Number)).collect();
    let mut rows = Rows::lines(vertex.line);
    for row in 0..vertex.count {
        let line = lines.advance_to_words().ok_or_else(|| vertex.cut_short(row))?;
        rows.push(row, lines.number());
        if has_lists {
            push_lists(&mut columns, vertex, line, lines.number(), budget)?;
        } else {
            push_line(&mut columns, line, lines.number(), budget)?;
        }
    }
    let array = |(column, property): (Column, &Property)| match property.form {
        Form::Number(_) => column.finish(),
        Form::List(..) => property.unusable(),
    };
    Ok((columns.into_iter().zip(&vertex.properties).map(array).collect(), rows))
}

/// The words of a line with lists in it, which are passed over.
fn push_lists(
    columns: &mut [Column],
    vertex: &Element,
    line: &[u8],
    number: usize,
    budget: &Budget,
) -> Parsed<()> {
    let mut given = words(line);
    let problem = |problem: String| Problem::at(format!("line {number}"), problem);
    for (column, property) in columns.iter_mut().zip(&vertex.properties) {
        let missing = || problem(format!("the line ends before {}", shown(property.name.as_bytes())));
        let word = given.next().ok_or_else(missing)?;
        match property.form {
            Form::Number(_) => column.push(word, number, budget)?,
            Form::List(..) => {
                let count = std::str::from_utf8(word).ok().and_then(|word| word.parse::<usize>().ok());
                let count = count.ok_or_else(|| {
                    problem(format!("{} where the count of a list is expected", shown(word)))
                })?;
                // Words are no more than the line has.
                if count > 0 && given.nth(count - 1).is_none() {
                    return Err(missing());
                }
            }
        }
    }
    if given.next().is_some() {
        Err(problem("there are more words than properties".to_owned()))
    } else {
        Ok(())
    }
}

/// The vertices behind the elements `before` in `data`.
fn binary(
    before: &[Element],
    vertex: &Element,
    data: &[u8],
    endian: Endian,
    budget: &Budget,
) -> Parsed<Vec<Array>> {
    let mut data = Data { rest: data, endian };
    for element in before {
        match element.length() {
            Some(_) => drop(data.records(element)?),
            None => data.each(element, |_, _| Ok(()))?,
        }
    }
    let Some(length) = vertex.length() else { return data.arrays(vertex, budget) };
    let records = data.records(vertex)?;
    let mut offset = 0;
    let fields = vertex.properties.iter().filter_map(|property| {
        let Form::Number(stored) = property.form else { return None };
        let place = offset;
        offset += stored.bytes(1)?;
        let name = property.name.clone();
        Some(Field { name, offset: place, components: 1, form: Ok((stored, endian)) })
    });
    let fields: Vec<Field> = fields.collect();
    let columns = columns(records, length, &fields, budget);
    let array = |(field, values): (Field, Result<Vec<f64>, Unusable>)| match values {
        Ok(values) => Array::new(field.name, 1, values),
        Err(unusable) => Array::unusable(field.name, unusable),
    };
    Ok(fields.into_iter().zip(columns).map(array).collect())
}

/// Binary data that are still to be read.
struct Data<'a> {
    rest: &'a [u8],
    endian: Endian,
}

impl<'a> Data<'a> {
    /// The next `count` bytes, if they are there.
    fn take(&mut self, count: Option<usize>) -> Option<&'a [u8]> {
        let (bytes, rest) = self.rest.split_at_checked(count?)?;
        self.rest = rest;
        Some(bytes)
    }

    /// The bytes of an element without lists.
    fn records(&mut self, element: &Element) -> Parsed<&'a [u8]> {
        let (left, length) = (self.rest.len(), element.length());
        let bytes = length.and_then(|length| element.count.checked_mul(length));
        self.take(bytes).ok_or_else(|| {
            let each = counted(length.unwrap_or(0), "byte");
            let problem =
                format!("{} of {each} are claimed, but only {} follow", element.count, counted(left, "byte"));
            Problem::at(element.place(), problem)
        })
    }

    /// Reads things with lists one by one, and gives each number with its property's index.
    fn each(
        &mut self,
        element: &Element,
        mut number: impl FnMut(usize, f64) -> Result<(), String>,
    ) -> Parsed<()> {
        for row in 0..element.count {
            for (index, property) in element.properties.iter().enumerate() {
                let read = match property.form {
                    Form::Number(stored) => self.number(stored).and_then(|value| number(index, value)),
                    Form::List(count, item) => self.skip_list(count, item),
                };
                read.map_err(|problem| {
                    let name = shown(property.name.as_bytes());
                    Problem::at(format!("{}, number {row}, property {name}", element.place()), problem)
                })?;
            }
        }
        Ok(())
    }

    fn number(&mut self, stored: Stored) -> Result<f64, String> {
        let bytes = self.take(stored.bytes(1)).ok_or("the data end here")?;
        let mut value = Vec::with_capacity(1);
        stored.decode(bytes, self.endian, 1, &mut value);
        Ok(value[0])
    }

    fn skip_list(&mut self, count: Stored, item: Stored) -> Result<(), String> {
        let count = self.number(count)?;
        if count < 0.0 {
            return Err(format!("a list of {count} items"));
        }
        // A count of 32 bits at most, exact as f64.
        let (count, left) = (count as usize, self.rest.len());
        self.take(item.bytes(count)).map(drop).ok_or_else(|| {
            format!(
                "a list of {} is claimed, but only {} follow",
                counted(count, "item"),
                counted(left, "byte")
            )
        })
    }

    /// The numbers of vertices that have lists too.
    fn arrays(&mut self, vertex: &Element, budget: &Budget) -> Parsed<Vec<Array>> {
        let mut columns: Vec<Vec<f64>> = vertex.properties.iter().map(|_| Vec::new()).collect();
        self.each(vertex, |index, value| {
            budget.push(&mut columns[index])?;
            columns[index].push(value);
            Ok(())
        })?;
        let array = |(property, values): (&Property, Vec<f64>)| match property.form {
            Form::Number(_) => Array::new(&*property.name, 1, values),
            Form::List(..) => property.unusable(),
        };
        Ok(vertex.properties.iter().zip(columns).map(array).collect())
    }
}
