//! Literals of Python, as the headers of NumPy's files have them: texts, whole numbers, `True` and `False`, tuples, lists and
//! dictionaries.

/// A literal.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Literal {
    Text(String),
    Number(usize),
    Truth(bool),
    /// A tuple or a list. What stands alone in round brackets is one of length 1.
    Sequence(Vec<Literal>),
    /// A dictionary: keys with their values.
    Pairs(Vec<(Literal, Literal)>),
}

/// How deep literals may stand in each other. NumPy's are 4 deep, and deeper by one for each record within a record.
const MOST_DEPTH: usize = 32;

impl Literal {
    /// The literal that `text` is, with blanks around it; `None` if it is something else.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let mut parser = Parser { rest: text, depth: 0 };
        let literal = parser.literal()?;
        parser.rest.trim_start().is_empty().then_some(literal)
    }

    /// What a dictionary has under the key `name`.
    pub(super) fn get(&self, name: &str) -> Option<&Self> {
        let Self::Pairs(pairs) = self else { return None };
        let is_key = |key: &Self| matches!(key, Self::Text(text) if text == name);
        pairs.iter().find(|(key, _)| is_key(key)).map(|(_, value)| value)
    }

    /// The numbers of a sequence of nothing else; a number alone is one too.
    pub(super) fn numbers(&self) -> Option<Vec<usize>> {
        match self {
            Self::Number(number) => Some(vec![*number]),
            Self::Sequence(items) => items.iter().map(|item| item.number()).collect(),
            _ => None,
        }
    }

    fn number(&self) -> Option<usize> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }
}

struct Parser<'a> {
    rest: &'a str,
    depth: usize,
}

impl Parser<'_> {
    /// Passes over blanks, and over `start` if it is next.
    fn skip(&mut self, start: &str) -> bool {
        self.rest = self.rest.trim_start();
        let tail = self.rest.strip_prefix(start);
        self.rest = tail.unwrap_or(self.rest);
        tail.is_some()
    }

    fn literal(&mut self) -> Option<Literal> {
        if self.skip("True") {
            return Some(Literal::Truth(true));
        }
        if self.skip("False") {
            return Some(Literal::Truth(false));
        }
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            return self.number();
        }
        self.depth += 1;
        if self.depth > MOST_DEPTH {
            return None;
        }
        let literal = if self.skip("(") {
            self.items(")", Self::literal).map(Literal::Sequence)
        } else if self.skip("[") {
            self.items("]", Self::literal).map(Literal::Sequence)
        } else if self.skip("{") {
            self.items("}", Self::pair).map(Literal::Pairs)
        } else {
            self.text().map(Literal::Text)
        };
        self.depth -= 1;
        literal
    }

    fn pair(&mut self) -> Option<(Literal, Literal)> {
        let key = self.literal()?;
        if self.skip(":") { Some((key, self.literal()?)) } else { None }
    }

    /// Items with commas between, up to `end`; a comma may stand behind the last.
    fn items<T>(&mut self, end: &str, item: fn(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let mut items = Vec::new();
        while !self.skip(end) {
            items.push(item(self)?);
            if !self.skip(",") {
                return self.skip(end).then_some(items);
            }
        }
        Some(items)
    }

    /// A number; Python 2 writes long ones as 3L.
    fn number(&mut self) -> Option<Literal> {
        let end = self.rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest.len());
        let (digits, rest) = self.rest.split_at(end);
        self.rest = rest.strip_prefix('L').unwrap_or(rest);
        digits.parse().ok().map(Literal::Number)
    }

    /// A text between quotation marks of either kind; Python 2 may write a `u` or a `b` before it.
    fn text(&mut self) -> Option<String> {
        let body = self.rest.strip_prefix(['u', 'b']).unwrap_or(self.rest);
        let mark = body.chars().next().filter(|mark| matches!(mark, '\'' | '"'))?;
        let mut characters = body[1..].chars();
        let mut text = String::new();
        loop {
            match characters.next()? {
                '\\' => text.push(escaped(&mut characters)?),
                c if c == mark => break,
                c => text.push(c),
            }
        }
        self.rest = characters.as_str();
        Some(text)
    }
}

/// The character that a backslash stands before, or that the digits behind its letter say.
fn escaped(characters: &mut std::str::Chars<'_>) -> Option<char> {
    let digits = match characters.next()? {
        'n' => return Some('\n'),
        'r' => return Some('\r'),
        't' => return Some('\t'),
        'x' => 2,
        'u' => 4,
        'U' => 8,
        other => return Some(other),
    };
    let mut code = 0;
    for _ in 0..digits {
        code = 16 * code + characters.next()?.to_digit(16)?;
    }
    char::from_u32(code)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str) -> Literal {
        Literal::Text(text.to_owned())
    }

    #[test]
    fn literals_of_python() {
        let parsed =
            Literal::parse(" {'a': [('x', '<f8', (3,)), (\"it's\", u'b')] , 'b':True,\n'c': 12L, }\n")
                .unwrap();
        let field =
            Literal::Sequence(vec![text("x"), text("<f8"), Literal::Sequence(vec![Literal::Number(3)])]);
        let other = Literal::Sequence(vec![text("it's"), text("b")]);
        assert_eq!(parsed.get("a"), Some(&Literal::Sequence(vec![field, other])));
        assert_eq!(parsed.get("b"), Some(&Literal::Truth(true)));
        assert_eq!(parsed.get("c").and_then(Literal::numbers), Some(vec![12]));
        assert_eq!(Literal::parse("()"), Some(Literal::Sequence(vec![])));
        assert_eq!(Literal::parse(r"'\'\\\n\xe9\u901f\U0001f600'"), Some(text("'\\\né速😀")));
    }

    #[test]
    fn what_is_none() {
        for wrong in [
            "",
            "(",
            "(1",
            "(1 2)",
            "{1}",
            "{1:}",
            "'a",
            "-1",
            "'\\x4",
            "'\\ud800'",
            "[1,,2]",
            "1 2",
            "None",
            "f(1)",
        ] {
            assert_eq!(Literal::parse(wrong), None, "{wrong}");
        }
        assert_eq!(Literal::parse(&"(".repeat(60_000)), None);
        assert_eq!(Literal::parse("99999999999999999999999999"), None);
    }
}
