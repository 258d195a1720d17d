use std::collections::HashMap;

use proptest::prelude::*;

use super::{Lattice, Mesh, march};

/// Values at the points of a lattice, and their derivatives.
struct Field {
    axes: [Vec<f64>; 3],
    values: Vec<f64>,
    gradient: [Vec<f64>; 3],
}

impl Field {
    fn new(counts: [usize; 3], spacing: f64, at: impl Fn([f64; 3]) -> (f64, [f64; 3])) -> Self {
        let axes = counts.map(|count| (0..count).map(|index| spacing * index as f64).collect::<Vec<_>>());
        let (mut values, mut gradient) = (Vec::new(), [const { Vec::new() }; 3]);
        for &z in &axes[2] {
            for &y in &axes[1] {
                for &x in &axes[0] {
                    let (value, slope) = at([x, y, z]);
                    values.push(value);
                    gradient.iter_mut().zip(slope).for_each(|(column, slope)| column.push(slope));
                }
            }
        }
        Self { axes, values, gradient }
    }

    /// A ball that falls as exp(−r²) from its centre, in a box of `cells` cells and side 1.
    fn ball(cells: usize, centre: [f64; 3], width: f64) -> Self {
        Self::new([cells + 1; 3], 1.0 / cells as f64, |x| {
            let from: [f64; 3] = std::array::from_fn(|axis| (x[axis] - centre[axis]) / width);
            let value = (-from.iter().map(|component| component * component).sum::<f64>()).exp();
            (value, from.map(|component| -2.0 * component / width * value))
        })
    }

    fn march(&self, level: f64, with_gradient: bool) -> Mesh {
        let axes = self.axes.each_ref().map(Vec::as_slice);
        let gradient = with_gradient.then(|| self.gradient.each_ref().map(Vec::as_slice));
        march(&Lattice { axes, values: &self.values, gradient }, level).unwrap()
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The corners of each triangle.
fn corners(mesh: &Mesh) -> impl Iterator<Item = [[f64; 3]; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|vertex| mesh.vertices[vertex as usize].position))
}

/// Area, and the volume that is enclosed; negative where triangles are seen from inside.
fn area_and_volume(mesh: &Mesh) -> (f64, f64) {
    corners(mesh).fold((0.0, 0.0), |(area, volume), [a, b, c]| {
        let normal = cross(minus(b, a), minus(c, a));
        (area + 0.5 * dot(normal, normal).sqrt(), volume + dot(a, cross(b, c)) / 6.0)
    })
}

/// Every edge as often as it goes one way and the other.
fn directed_edges(mesh: &Mesh) -> HashMap<(u32, u32), [usize; 2]> {
    let mut edges: HashMap<(u32, u32), [usize; 2]> = HashMap::new();
    for [a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            edges.entry((*from.min(to), *from.max(to))).or_default()[usize::from(from > to)] += 1;
        }
    }
    edges
}

/// That no edge has two triangles on one side, that as many are open as the mesh says, and that around every vertex there is one fan
/// of triangles, but for the rims of holes, which may touch.
fn assert_manifold(mesh: &Mesh) {
    let edges = directed_edges(mesh);
    assert!(edges.values().all(|ways| ways.iter().all(|&count| count <= 1)));
    let open = edges.values().filter(|ways| ways.iter().sum::<usize>() == 1).count();
    assert_eq!(open, mesh.open_at_border + mesh.open_at_gaps);
    assert_eq!(edges.len(), mesh.edges());
    // a fan has as many edges as triangles, or one more where it is open; two fans that touch would have two open ends each
    let mut around = vec![HashMap::new(); mesh.vertices.len()];
    for triangle in &mesh.triangles {
        for turn in 0..3 {
            let [at, next, last] = [0, 1, 2].map(|step| triangle[(turn + step) % 3]);
            assert!(around[at as usize].insert(next, last).is_none());
        }
    }
    for fan in around {
        let start = fan.keys().find(|next| !fan.values().any(|last| last == *next));
        let mut at = *start.or_else(|| fan.keys().next()).expect("every vertex has a triangle");
        let mut walked = 0;
        while let Some(&next) = fan.get(&at).filter(|_| walked < fan.len()) {
            (at, walked) = (next, walked + 1);
        }
        let is_one = walked == fan.len() || mesh.open_at_gaps > 0;
        assert!(is_one, "two fans of triangles touch in one vertex");
    }
}

#[test]
fn a_sphere_of_40_cells_is_closed_with_area_and_volume_within_one_percent() {
    // nowhere special on the lattice, and 40 cells across
    let (centre, radius, width) = ([0.503, 0.497, 0.511], 0.4, 0.45);
    let field = Field::ball(50, centre, width);
    let mesh = field.march((-(radius / width) * (radius / width)).exp(), true);
    assert_manifold(&mesh);
    assert_eq!((mesh.open_at_border, mesh.open_at_gaps), (0, 0));
    assert!(directed_edges(&mesh).values().all(|ways| *ways == [1, 1]));
    assert_eq!(mesh.vertices.len() + mesh.triangles.len(), mesh.edges() + 2, "Euler's characteristic");
    let (area, volume) = area_and_volume(&mesh);
    let pi = std::f64::consts::PI;
    let (true_area, true_volume) = (4.0 * pi * radius * radius, 4.0 / 3.0 * pi * radius.powi(3));
    assert!((area / true_area - 1.0).abs() < 0.01, "{}", area / true_area);
    assert!((volume / true_volume - 1.0).abs() < 0.01, "{}", volume / true_volume);
    for vertex in &mesh.vertices {
        let from = minus(vertex.position, centre);
        let distance = dot(from, from).sqrt();
        // linear interpolation over the diagonal of a cell: 3 δ² A″ / (8 |A′|)
        assert!((distance - radius).abs() < 1e-3, "{distance}");
        assert!((dot(vertex.normal, vertex.normal) - 1.0).abs() < 1e-14);
        assert!(dot(from, vertex.normal) > distance * 2_f64.to_radians().cos());
    }
}

#[test]
fn normals_come_from_the_gradient_or_else_from_differences() {
    let centre = [0.5; 3];
    let field = Field::ball(24, centre, 0.4);
    let (own, differences) = (field.march(0.5, true), field.march(0.5, false));
    assert_eq!(own.triangles, differences.triangles);
    for (own, difference) in own.vertices.iter().zip(&differences.vertices) {
        assert_eq!(own.position, difference.position);
        assert!(dot(own.normal, difference.normal) > 2_f64.to_radians().cos());
    }
    // a gradient that says something else is believed; one that says nothing is not
    let mut field = Field::ball(24, centre, 0.4);
    field.gradient = [vec![0.0; 15625], vec![3.0; 15625], vec![-4.0; 15625]];
    assert!(field.march(0.5, true).vertices.iter().all(|vertex| {
        minus(vertex.normal, [0.0, -0.6, 0.8]).iter().all(|component| component.abs() < 1e-15)
    }));
    for nothing in [0.0, f64::NAN, f64::INFINITY] {
        field.gradient = [const { Vec::new() }; 3].map(|_: Vec<f64>| vec![nothing; 15625]);
        assert!(field.march(0.5, true).vertices.iter().all(|vertex| {
            dot(minus(vertex.position, centre), vertex.normal) > 0.0
                && (dot(vertex.normal, vertex.normal) - 1.0).abs() < 1e-14
        }));
    }
}

#[test]
fn a_plane_is_met_exactly_whatever_its_direction() {
    for slope in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.3, -0.5, 0.8], [1.0, 1.0, 1.0], [-0.2, -0.1, 0.05]] {
        let field = Field::new([6, 5, 7], 0.25, |x| (dot(x, slope), slope));
        let level = dot([0.61, 0.53, 0.77], slope);
        let mesh = field.march(level, true);
        assert_manifold(&mesh);
        assert!(mesh.open_at_border > 0 && mesh.open_at_gaps == 0 && mesh.triangles.len() > 20);
        let length = dot(slope, slope).sqrt();
        for vertex in &mesh.vertices {
            // 1/1024 of the longest edge is as far as a vertex may be moved
            assert!((dot(vertex.position, slope) - level).abs() < 1e-3 * 0.25 * 3_f64.sqrt() * length);
        }
        for [a, b, c] in corners(&mesh) {
            assert!(
                dot(cross(minus(b, a), minus(c, a)), slope) < 0.0,
                "seen from the low side, counter-clockwise"
            );
        }
    }
}

#[test]
fn an_open_surface_tells_its_open_edges() {
    // the upper half of a ball: the border cuts it along its equator
    let mut field = Field::ball(20, [0.5, 0.5, 0.0], 0.4);
    let half = field.march(0.4, true);
    assert_manifold(&half);
    assert!(half.open_at_border > 40 && half.open_at_gaps == 0);
    assert_eq!(half.vertices.len() + half.triangles.len(), half.edges() + 1, "a disc");
    // a point without value on the surface tears a hole
    let number = field.values.iter().rposition(|&value| value > 0.4).unwrap();
    field.values[number] = f64::NAN;
    let torn = field.march(0.4, true);
    assert_manifold(&torn);
    assert!(torn.open_at_gaps > 0 && torn.triangles.len() < half.triangles.len());
    assert_eq!(torn.open_at_border, half.open_at_border);
}

#[test]
fn there_is_no_surface_where_no_box_is_crossed() {
    let field = Field::ball(8, [0.5; 3], 0.4);
    for level in [1.0, 1.5, 0.0, -1.0] {
        assert_eq!(field.march(level, true), Mesh::default(), "{level}");
    }
    let flat = Field::new([8, 8, 1], 1.0, |[x, ..]| (x, [1.0, 0.0, 0.0]));
    assert_eq!(flat.march(3.5, true), Mesh::default());
    let nothing = Field::new([4, 4, 4], 1.0, |_| (f64::NAN, [0.0; 3]));
    assert_eq!(nothing.march(0.0, true), Mesh::default());
}

#[test]
fn values_as_large_as_numbers_are_interpolated() {
    let field = Field::new([2; 3], 1.0, |[x, ..]| (if x > 0.5 { f64::MAX } else { -f64::MAX }, [0.0; 3]));
    let mesh = field.march(0.0, true);
    assert!(mesh.vertices.iter().all(|vertex| vertex.position[0] == 0.5 && vertex.normal[0] < 0.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Values from a few, so that many are the level itself, and some are none.
    #[test]
    fn every_surface_is_manifold_and_open_only_where_it_says_so(
        counts in prop::array::uniform3(1..6_usize),
        draws in prop::collection::vec(0..12_u8, 125),
        has_gaps in prop::bool::ANY,
        is_walled in prop::bool::ANY,
    ) {
        let value = |draw: u8| match draw {
            0 if has_gaps => f64::NAN,
            1 if has_gaps => f64::INFINITY,
            draw => f64::from(draw % 5) - 2.0,
        };
        let mut field = Field::new(counts, 1.0, |[x, y, z]| {
            let place = [x, y, z].map(|x| x as usize);
            let is_wall = (0..3).any(|axis| place[axis] == 0 || place[axis] + 1 == counts[axis]);
            let drawn = value(draws[place[0] + 5 * (place[1] + 5 * place[2])]);
            (if is_walled && is_wall { -1.0 } else { drawn }, [0.0; 3])
        });
        let mesh = field.march(0.0, false);
        assert_manifold(&mesh);
        prop_assert!(!is_walled || mesh.open_at_border == 0);
        prop_assert!(has_gaps || mesh.open_at_gaps == 0);
        for [a, b, c] in corners(&mesh) {
            let normal = cross(minus(b, a), minus(c, a));
            prop_assert!(dot(normal, normal) > 0.0, "a triangle without area");
        }
        // more inside and less outside crosses the same edges
        field.values.iter_mut().for_each(|value| *value *= 8.0);
        prop_assert_eq!(field.march(0.0, false).triangles, mesh.triangles);
    }
}
