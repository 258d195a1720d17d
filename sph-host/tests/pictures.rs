//! Pictures: the right size, colours that follow the values, grey where there is none, nothing that panics.

use std::fs;
use std::time::Duration;

use sph_host::output::{Column, Grid, Precision, Role, Table, Target, WriteError, write};
use sph_host::picture::animation::Animation;
use sph_host::picture::heat_map::{self, HeatMap, Panel, Plane};
use sph_host::picture::particles::{self, Frame};
use sph_host::picture::plot::{self, Mark, Plot, Series};
use sph_host::picture::{Image, Palette, PictureError};

const GREY: [u8; 3] = [176; 3];
const FIRST: [u8; 3] = [68, 1, 84]; // of viridis
const LAST: [u8; 3] = [253, 231, 37];

fn pixels(image: &Image) -> impl Iterator<Item = [u8; 3]> {
    image.rgb.chunks_exact(3).map(|pixel| [pixel[0], pixel[1], pixel[2]])
}

/// The longest unbroken runs of a colour, across and upwards: the size of a shape of that colour.
fn runs(image: &Image, colour: [u8; 3]) -> (u32, u32) {
    let (mut across, mut upwards) = (0, 0);
    let mut columns = vec![0; image.width as usize];
    for row in pixels(image).collect::<Vec<_>>().chunks(image.width as usize) {
        let mut run = 0;
        for (pixel, column) in row.iter().zip(&mut columns) {
            (run, *column) = if *pixel == colour { (run + 1, *column + 1) } else { (0, 0) };
            (across, upwards) = (across.max(run), upwards.max(*column));
        }
    }
    (across, upwards)
}

fn decode(bytes: &[u8]) -> Image {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgb).unwrap();
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    Image { width: info.width, height: info.height, rgb }
}

fn map(counts: [usize; 2], upper: [f64; 2], values: Vec<f64>) -> HeatMap {
    let plane = Plane { counts, lower: [0.0; 2], upper, axes: ["x", "y"].map(String::from) };
    let panel = Panel { title: String::from("a"), values, palette: Palette::Viridis, arrows: None };
    HeatMap { title: String::from("title"), plane, rows: vec![vec![panel]] }
}

#[test]
fn colours_follow_values_and_missing_ones_are_grey() {
    let image = heat_map::draw(&map([4, 1], [4.0, 1.0], vec![0.0, 0.5, 1.0, f64::NAN])).unwrap();
    let count = |colour| pixels(&image).filter(|&pixel| pixel == colour).count();
    // A quarter of the panel each, at least.
    for colour in [FIRST, [33, 144, 140], LAST, GREY] {
        let close = |pixel: &[u8; 3]| pixel.iter().zip(colour).all(|(&a, b)| a.abs_diff(b) <= 2);
        assert!(pixels(&image).filter(close).count() > 30_000, "{colour:?}");
    }
    assert!(count([255; 3]) > 100_000, "the paper is white");
}

#[test]
fn the_first_cell_is_at_the_lower_left() {
    let image = heat_map::draw(&map([2, 2], [1.0, 1.0], vec![0.0, 1.0, 1.0, f64::NAN])).unwrap();
    let places = |colour| {
        let found = pixels(&image).zip(0_u32..).filter(move |&(pixel, _)| pixel == colour);
        // The colour bar and the sample of grey are at the right.
        let found = found.map(|(_, index)| (index % image.width, index / image.width));
        found.filter(|place| place.0 < image.width * 3 / 4).collect::<Vec<_>>()
    };
    let (first, missing) = (places(FIRST), places(GREY));
    let right = first.iter().map(|place| place.0).max().unwrap();
    let top = first.iter().map(|place| place.1).min().unwrap();
    let panel: Vec<_> = missing.iter().filter(|place| place.1 < top).collect();
    assert!(panel.len() > 10_000 && panel.iter().all(|place| place.0 > right), "grey at the upper right");
}

#[test]
fn a_box_of_two_to_one_looks_two_to_one() {
    for (upper, ratio) in [([2.0, 1.0], 2.0), ([1.0, 1.0], 1.0), ([1e-9, 3e-9], 1.0 / 3.0)] {
        let image = heat_map::draw(&map([5, 5], upper, vec![f64::NAN; 25])).unwrap();
        assert_eq!(image.width, 1100);
        // The panel is all grey.
        let (width, height) = runs(&image, GREY);
        assert!(
            (f64::from(width) / f64::from(height) - ratio).abs() < 0.01 * ratio,
            "{width} {height} {ratio}"
        );
    }
}

#[test]
fn a_sample_on_a_grid_becomes_a_png() {
    let directory = tempfile::tempdir().unwrap();
    let grid = Grid::new(&[8, 8, 3], &[0.0; 3], &[1.0; 3]).unwrap();
    let coordinates = grid.coordinates();
    // Only the middle layer has values.
    let middle = |cell: usize, value: f64| if coordinates[2].values[cell] == 0.5 { value } else { f64::NAN };
    let x = &coordinates[0].values;
    let column = |name: &str, f: &dyn Fn(f64) -> f64| {
        Column::new(name, (0..grid.cells()).map(|cell| middle(cell, f(x[cell]))).collect())
    };
    let mut table = Table {
        columns: vec![
            column("a", &|x| x * x),
            column("a_dx", &|x| 2.0 * x).in_role(Role::Gradient { of: 0, axis: 0 }),
            column("a_dy", &|_| 0.0).in_role(Role::Gradient { of: 0, axis: 1 }),
        ],
        coordinates: coordinates.clone(),
        grid: Some(grid.clone()),
        precision: Precision::F64,
        caption: String::from("caption"),
    };
    let draw = |table: &Table, name: &str| {
        let target = Target::new(directory.path().join(name));
        write(table, &target).map(|()| decode(&fs::read(&target.path).unwrap()))
    };
    // Without a_dz there is no gradient: three panels, two in a row.
    let three = draw(&table, "three.png").unwrap();
    assert_eq!(three.width, 1400);
    table.columns.push(column("a_dz", &|_| 0.0).in_role(Role::Gradient { of: 0, axis: 2 }));
    let pair = draw(&table, "pair.png").unwrap();
    assert!(pair.width == 1400 && pair.height < three.height);
    assert!(runs(&pair, GREY).0 < 5, "the middle layer has all values");
    let left =
        pair.rgb.chunks_exact(3 * 1400).filter(|row| row[..3 * 700].chunks_exact(3).any(|p| p == LAST));
    let right =
        pair.rgb.chunks_exact(3 * 1400).filter(|row| row[3 * 700..].chunks_exact(3).any(|p| p == LAST));
    assert!(left.count() > 300 && right.count() == 0, "another palette for the gradient");
    table.columns = (0..13).map(|n| Column::new(format!("q{n}"), x.clone())).collect();
    let error = draw(&table, "many.png").unwrap_err();
    assert!(
        matches!(error, WriteError::Picture(PictureError::TooMany { count: 13, limit: 12 }))
            && !error.is_usage()
    );
    assert!(!directory.path().join("many.png").exists());
}

#[test]
fn constants_and_extremes_are_drawn() {
    let values =
        [[0.0; 4], [1000.0; 4], [f64::NAN; 4], [f64::MAX, f64::MIN, 0.0, 1.0], [5e-324, 0.0, -5e-324, 0.0]];
    for values in values {
        for palette in [Palette::Viridis, Palette::Inferno, Palette::BlueRed] {
            let mut map = map([2, 2], [1e300, 1e-300], values.to_vec());
            map.rows[0][0].palette = palette;
            map.rows[0][0].arrows = Some([values.to_vec(), values.to_vec()]);
            heat_map::draw(&map).unwrap();
            map.plane.upper = [1e-300, 1e300];
            heat_map::draw(&map).unwrap();
        }
    }
}

#[test]
fn lines_have_their_legend_and_break_where_there_is_no_value() {
    let series = |name: &str, y: f64, mark| Series {
        name: String::from(name),
        points: (0..11).map(|x| [f64::from(x), if x == 5 { f64::NAN } else { y }]).collect(),
        mark,
    };
    let plot = Plot {
        series: vec![series("one", 1.0, Mark::Line), series("two", 2.0, Mark::Points)],
        ..Plot::default()
    };
    let image = plot::draw("title", &[vec![plot]]).unwrap();
    let [blue, orange] = [[78, 121, 167], [242, 142, 44]];
    let (wide, high) = runs(&image, blue);
    let count = |colour| pixels(&image).filter(|&pixel| pixel == colour).count() as u32;
    // Four of ten intervals on either side of the gap, over an area of about 920 pixels.
    assert!((330..400).contains(&wide) && high <= 4, "{wide} {high}");
    assert!(count(orange) > 300);
    assert_eq!(plot::draw("", &[]).unwrap_err(), PictureError::Empty);
    let diverging = Series {
        name: String::new(),
        points: vec![[0.0, f64::INFINITY], [0.1, 1e300], [1.0, 0.0]],
        mark: Mark::Line,
    };
    plot::draw("", &[vec![Plot { series: vec![diverging], y_range: Some([0.0, 1.0]), ..Plot::default() }]])
        .unwrap();
    let wrong =
        Plot { y_range: Some([1.0, f64::INFINITY]), y_title: String::from("f(q)"), ..Plot::default() };
    assert!(
        matches!(plot::draw("", &[vec![wrong]]), Err(PictureError::Range { what, .. }) if what == "f(q)")
    );
}

fn frame<'a>(positions: &'a [[f64; 2]], values: &'a [f64]) -> Frame<'a> {
    Frame {
        title: "t = 0",
        positions,
        values,
        value_title: "speed",
        range: [0.0, 1.0],
        palette: Palette::Viridis,
        lower: [0.0, 0.0],
        upper: [2.0, 1.0],
        radius: 0.1,
        width: 800,
    }
}

#[test]
fn particles_are_round_and_coloured_and_frames_agree_in_size() {
    let one = particles::draw(&frame(&[[1.0, 0.5]], &[f64::NAN])).unwrap();
    let (width, height) = runs(&one, GREY);
    assert!(width > 40 && width.abs_diff(height) <= 1, "{width} {height}");
    let other =
        particles::draw(&frame(&[[1.0, f64::NAN], [1e300, 0.0], [0.3, 0.3]], &[1.0, 2.0, 1e9])).unwrap();
    assert_eq!((one.width, one.height), (other.width, other.height));
    assert_eq!(one.width, 800);
    let mut bytes = Vec::new();
    let mut animation = Animation::begin(&mut bytes, 800, one.height, Duration::from_millis(40)).unwrap();
    animation.push(&one).unwrap();
    animation.push(&other).unwrap();
    assert!(animation.push(&Image { width: 1, height: 1, rgb: vec![0; 3] }).is_err());
    animation.finish().unwrap();
    let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let mut delays = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        delays.push(frame.delay);
    }
    assert_eq!(delays, [4, 4]);
    assert!(matches!(particles::draw(&frame(&[[0.0; 2]], &[])), Err(PictureError::Length { .. })));
}
