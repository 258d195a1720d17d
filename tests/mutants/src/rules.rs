//! What may be changed into what.

use syn::{AngleBracketedGenericArguments, BinOp, Expr, GenericArgument, Lit, ReturnType, Type};

/// What an operator may be changed into.
pub(crate) fn operators(operator: &BinOp) -> &'static [&'static str] {
    match operator {
        BinOp::Add(_) => &["-"],
        BinOp::Sub(_) => &["+"],
        BinOp::Mul(_) => &["/"],
        BinOp::Div(_) | BinOp::Rem(_) => &["*"],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::BitXor(_) | BinOp::BitAnd(_) => &["|"],
        BinOp::BitOr(_) => &["&"],
        BinOp::Shl(_) => &[">>"],
        BinOp::Shr(_) => &["<<"],
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::Lt(_) => &["<=", ">="],
        BinOp::Le(_) => &["<", ">"],
        BinOp::Gt(_) => &[">=", "<="],
        BinOp::Ge(_) => &[">", "<"],
        BinOp::AddAssign(_) => &["-="],
        BinOp::SubAssign(_) => &["+="],
        BinOp::MulAssign(_) => &["/="],
        BinOp::DivAssign(_) | BinOp::RemAssign(_) => &["*="],
        BinOp::BitXorAssign(_) | BinOp::BitAndAssign(_) => &["|="],
        BinOp::BitOrAssign(_) => &["&="],
        BinOp::ShlAssign(_) => &[">>="],
        BinOp::ShrAssign(_) => &["<<="],
        _ => &[],
    }
}

/// Methods that compute with two numbers: the name of the opposite one.
pub(crate) fn method(name: &str) -> Option<String> {
    for prefix in ["wrapping_", "saturating_", "checked_"] {
        if let Some(rest) = name.strip_prefix(prefix) {
            let (_, to) = [("add", "sub"), ("sub", "add"), ("mul", "add"), ("shl", "shr"), ("shr", "shl")]
                .into_iter()
                .find(|(from, _)| *from == rest)?;
            return Some(format!("{prefix}{to}"));
        }
    }
    match name {
        "min" => Some("max".into()),
        "max" => Some("min".into()),
        _ => None,
    }
}

/// Constants: the name of another one.
pub(crate) fn constant(name: &str) -> Option<&'static str> {
    match name {
        "ZERO" => Some("ONE"),
        "ONE" => Some("ZERO"),
        "MIN" => Some("MAX"),
        "MAX" => Some("MIN"),
        _ => None,
    }
}

/// The number of `::<3>`.
pub(crate) fn number_of_turbofish(turbofish: &AngleBracketedGenericArguments) -> Option<&Lit> {
    match turbofish.args.first()? {
        GenericArgument::Const(Expr::Lit(number)) => Some(&number.lit),
        _ => None,
    }
}

/// A number one larger.
pub(crate) fn literal(literal: &Lit) -> Option<String> {
    match literal {
        Lit::Int(number) => {
            let value: u128 = number.base10_parse().ok()?;
            Some(format!("{}{}", value.checked_add(1)?, number.suffix()))
        }
        Lit::Float(number) => {
            let value: f64 = number.base10_parse().ok()?;
            Some(format!("{:?}{}", value + 1.0, number.suffix()))
        }
        Lit::Bool(value) => Some((!value.value).to_string()),
        _ => None,
    }
}

/// What a function may return at once, by its type.
pub(crate) fn returned(output: &ReturnType) -> Vec<&'static str> {
    let ReturnType::Type(_, output) = output else { return vec!["return;"] };
    let Type::Path(path) = &**output else { return Vec::new() };
    let Some(last) = path.path.segments.last() else { return Vec::new() };
    match last.ident.to_string().as_str() {
        "bool" => vec!["return true;", "return false;"],
        "u8" | "u16" | "u32" | "u64" | "u128" | "usize" | "i8" | "i16" | "i32" | "i64" | "i128" | "isize" => {
            vec!["return 0;", "return 1;"]
        }
        "f32" | "f64" => vec!["return 0.0;", "return 1.0;"],
        "T" => vec!["return T::ZERO;", "return T::ONE;"],
        "Option" => vec!["return None;"],
        _ => Vec::new(),
    }
}

/// Whether a condition binds names with `let`: such a chain cannot be put into parentheses.
pub(crate) fn binds(expression: &Expr) -> bool {
    match expression {
        Expr::Let(_) => true,
        Expr::Binary(binary) => binds(&binary.left) || binds(&binary.right),
        _ => false,
    }
}
