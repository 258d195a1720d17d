//! The header says what the library is: every prototype and constant of one is in the other, with the same types and values.

use core::any::type_name;
use core::ffi::{c_char, c_void};
use fluisim_c::export::{self, Behaviour, Signature};
use fluisim_c::fluid::Fluid;
use fluisim_c::{Q16, code, fields, pixels};
use sph_core::fluid::Particle;
use std::collections::BTreeMap;

const HEADER: &str = include_str!("../include/fluisim.h");

/// The types of arguments and of the result as Rust names them, by the name of the function.
type Functions = BTreeMap<String, (Vec<String>, String)>;

/// What C's types are in Rust.
fn types() -> BTreeMap<String, &'static str> {
    let mut types = BTreeMap::new();
    let mut insert =
        |c: &str, rust| assert!(types.insert(c.to_owned(), rust).is_none(), "{c} is there twice");
    macro_rules! pointers {
        ($($c:literal $Type:ty),+ $(,)?) => {$(
            insert(concat!($c, " *"), type_name::<*mut $Type>());
            insert(concat!("const ", $c, " *"), type_name::<*const $Type>());
            insert(concat!($c, " **"), type_name::<*mut *mut $Type>());
        )+};
    }
    pointers!(
        "void" c_void, "float" f32, "fluisim_q16" Q16, "uint8_t" u8, "char" c_char, "fluisim_settings" Behaviour,
        "fluisim_f32_2d" Fluid<f32, 2>, "fluisim_q16_2d" Fluid<Q16, 2>, "fluisim_f32_3d" Fluid<f32, 3>,
        "fluisim_q16_3d" Fluid<Q16, 3>,
    );
    macro_rules! values {
        ($($c:literal $Type:ty),+ $(,)?) => { $(insert($c, type_name::<$Type>());)+ };
    }
    values!(
        "float" f32, "fluisim_q16" Q16, "uint8_t" u8, "uint16_t" u16, "uint32_t" u32, "int32_t" i32, "size_t" usize,
        "float[2]" *mut [f32; 2], "const float[2]" *const [f32; 2], "fluisim_q16[2]" *mut [Q16; 2],
        "const fluisim_q16[2]" *const [Q16; 2], "float[3]" *mut [f32; 3], "const float[3]" *const [f32; 3],
        "fluisim_q16[3]" *mut [Q16; 3], "const fluisim_q16[3]" *const [Q16; 3],
    );
    types
}

/// The header without comments, lines of the preprocessor and the braces of C++.
fn declarations() -> String {
    let mut text = String::new();
    let mut rest = HEADER;
    while let Some((before, after)) = rest.split_once("/*") {
        text += before;
        rest = after.split_once("*/").expect("a comment ends").1;
    }
    text += rest;
    let joined = text.replace("\\\n", " ");
    joined.lines().filter(|line| !line.starts_with('#')).collect::<Vec<_>>().join(" ")
}

/// An argument's type: what is left without its name.
fn without_name(argument: &str) -> String {
    let (declared, array) = argument.split_at(argument.find('[').unwrap_or(argument.len()));
    let name = declared.trim_end_matches(|letter: char| letter.is_alphanumeric() || letter == '_');
    format!("{}{array}", name.trim())
}

fn functions_of_the_header() -> Functions {
    let types = types();
    let rust =
        |c: String| (*types.get(&c).unwrap_or_else(|| panic!("no type {c:?} in the table"))).to_owned();
    let mut functions = Functions::new();
    for statement in declarations().split(';') {
        let statement = statement.rsplit('{').next().unwrap_or_default().trim();
        let Some((head, arguments)) = statement.split_once('(') else { continue };
        let name_at = head.rfind(|letter: char| !(letter.is_alphanumeric() || letter == '_')).unwrap() + 1;
        let arguments = arguments.trim_end_matches(')').split(',');
        let arguments = arguments.map(|argument| rust(without_name(argument.trim()))).collect();
        let function = (arguments, rust(head[..name_at].trim().to_owned()));
        assert!(functions.insert(head[name_at..].to_owned(), function).is_none(), "{head} is there twice");
    }
    functions
}

fn functions_of_the_library() -> Functions {
    let mut lists: Vec<&[Signature]> = vec![pixels::SIGNATURES];
    lists.extend([export::f32_2d::SIGNATURES, export::q16_2d::SIGNATURES, export::f32_3d::SIGNATURES]);
    lists.extend([export::q16_3d::SIGNATURES, fields::f32_2d::SIGNATURES, fields::q16_2d::SIGNATURES]);
    lists.extend([fields::f32_3d::SIGNATURES, fields::q16_3d::SIGNATURES, fields::SIGNATURES]);
    let of = |signature: &Signature| {
        let arguments = signature.arguments.iter().map(|argument| argument().to_owned()).collect();
        (signature.name.to_owned(), (arguments, (signature.result)().to_owned()))
    };
    lists.into_iter().flatten().map(of).collect()
}

#[test]
fn every_function_has_the_types_of_its_prototype() {
    let (header, library) = (functions_of_the_header(), functions_of_the_library());
    for name in header.keys().chain(library.keys()) {
        assert_eq!(
            header.get(name),
            library.get(name),
            "{name}: the header on the left, the library on the right"
        );
    }
    assert!(library.len() > 80, "{}", library.len());
}

/// The constants of the header that are numbers.
fn constants() -> BTreeMap<&'static str, i32> {
    let defines = HEADER.lines().filter_map(|line| line.strip_prefix("#define FLUISIM_"));
    let number = |line: &'static str| {
        let (name, rest) = line.split_once(' ')?;
        let value = rest.split_whitespace().next()?.trim_matches(['(', ')']);
        Some((name, value.parse().ok()?))
    };
    defines.filter_map(number).collect()
}

#[test]
fn every_constant_has_the_value_of_the_library() {
    let mut expected: BTreeMap<String, i32> =
        code::CODES.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
    for (number, (name, _)) in sph_core::kernel::LIST.iter().enumerate() {
        expected.insert(format!("KERNEL_{}", name.to_uppercase().replace('-', "_")), number as i32);
    }
    let found: BTreeMap<String, i32> =
        constants().into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    assert_eq!(found, expected);
}

#[test]
fn the_macros_of_sizes_have_the_numbers_of_the_library() {
    let particles = [
        ("F32_2D", size_of::<Particle<f32, 2>>()),
        ("Q16_2D", size_of::<Particle<Q16, 2>>()),
        ("F32_3D", size_of::<Particle<f32, 3>>()),
        ("Q16_3D", size_of::<Particle<Q16, 3>>()),
    ];
    for (name, size) in particles {
        let line = format!(
            "#define FLUISIM_{name}_BYTES(capacity, cells) FLUISIM_BYTES(capacity, cells, {size}u)\n"
        );
        assert!(HEADER.contains(&line), "the header does not have\n{line}");
    }
    assert_eq!(fluisim_c::fluid::HEAD, 16 + 6 * size_of::<usize>());
    assert_eq!((size_of::<Behaviour>(), size_of::<Q16>(), align_of::<Q16>()), (3, 4, 4));
}
