//! From box to box through a lattice.

use super::tetrahedron::{Edge, Tetrahedron};
use super::{Lattice, Mesh, TooManyVertices, Vertex};

/// How near to the end of an edge a vertex may lie, in lengths of the edge. Single precision still tells vertices around one lattice
/// point apart where a coordinate is 8000 boxes from zero.
const NEAREST: f64 = 1.0 / 1024.0;

/// No vertex yet.
const NONE: u32 = u32::MAX;

/// The edges that begin at a lattice point: one for each other corner of the box above it.
const EDGES: usize = 7;

/// The surface on which the values of a lattice have a level. Points with a greater value are inside.
///
/// The order of vertices and triangles follows from the values alone.
///
/// ```
/// use sph_host::surface::{Lattice, march};
///
/// // one value of 1 among zeros, at (2, 2, 2)
/// let axis = [1.0, 2.0, 3.0];
/// let mut values = [0.0; 27];
/// values[13] = 1.0;
/// let mesh = march(&Lattice { axes: [&axis; 3], values: &values, gradient: None }, 0.5)?;
/// assert_eq!((mesh.vertices.len(), mesh.triangles.len(), mesh.edges()), (14, 24, 36));
/// assert_eq!(mesh.open_at_border, 0);
/// assert!(mesh.vertices.iter().any(|vertex| vertex.position == [1.5, 2.0, 2.0] && vertex.normal[0] < 0.0));
/// # Ok::<(), sph_host::surface::TooManyVertices>(())
/// ```
///
/// # Errors
///
/// [`TooManyVertices`].
pub fn march(lattice: &Lattice<'_>, level: f64) -> Result<Mesh, TooManyVertices> {
    let [nx, ny, nz] = lattice.counts();
    let layer = || vec![NONE; nx * ny * EDGES];
    let mut march = March {
        lattice,
        level,
        tetrahedra: Tetrahedron::all(),
        mesh: Mesh::default(),
        layers: [layer(), layer()],
    };
    for z in 0..nz.saturating_sub(1) {
        for y in 0..ny.saturating_sub(1) {
            march.cross_row(y, z)?;
        }
        march.layers.swap(0, 1);
        march.layers[1].fill(NONE);
    }
    Ok(march.mesh)
}

struct March<'a> {
    lattice: &'a Lattice<'a>,
    level: f64,
    tetrahedra: [Tetrahedron; 6],
    mesh: Mesh,
    /// The vertices on edges that begin in the lower and in the upper layer of points of the boxes at hand.
    layers: [Vec<u32>; 2],
}

/// Which corners of a box have a value, and which of these lie inside: a bit a corner.
#[derive(Clone, Copy)]
struct Corners {
    valued: u8,
    inside: u8,
}

impl March<'_> {
    /// The boxes of a row along x.
    fn cross_row(&mut self, y: usize, z: usize) -> Result<(), TooManyVertices> {
        let mut lower = self.lower_corners([0, y, z]);
        for x in 1..self.lattice.axes[0].len() {
            let upper = self.lower_corners([x, y, z]);
            let corners = Corners {
                valued: lower.valued | upper.valued << 1,
                inside: lower.inside | upper.inside << 1,
            };
            if corners.inside != 0 && corners.inside != corners.valued {
                self.cross_box([x - 1, y, z], corners)?;
            }
            lower = upper;
        }
        Ok(())
    }

    /// The corners on the lower side of a box along x, whose bits are the even ones.
    fn lower_corners(&self, [x, y, z]: [usize; 3]) -> Corners {
        let [_, row, layer] = self.lattice.strides();
        let first = x + y * row + z * layer;
        let numbers = [first, first + row, first + layer, first + row + layer];
        numbers.into_iter().enumerate().fold(Corners { valued: 0, inside: 0 }, |corners, (place, number)| {
            let Some(value) = self.lattice.value(number) else { return corners };
            Corners {
                valued: corners.valued | 1 << (2 * place),
                inside: corners.inside | u8::from(value > self.level) << (2 * place),
            }
        })
    }

    fn cross_box(&mut self, place: [usize; 3], corners: Corners) -> Result<(), TooManyVertices> {
        for tetrahedron in self.tetrahedra {
            if tetrahedron.among(corners.valued) == 15 {
                self.cross(place, &tetrahedron, tetrahedron.among(corners.inside))?;
            }
        }
        Ok(())
    }

    /// Adds the triangles of a tetrahedron.
    fn cross(
        &mut self,
        place: [usize; 3],
        tetrahedron: &Tetrahedron,
        inside: u8,
    ) -> Result<(), TooManyVertices> {
        let (edges, count) = tetrahedron.crossed(inside);
        let mut corners = [NONE; 4];
        for (corner, &edge) in corners.iter_mut().zip(&edges[..count]) {
            *corner = self.vertex(place, edge)?;
        }
        let [first, ..] = corners;
        let fan = corners[..count].windows(2).skip(1).map(|pair| [first, pair[0], pair[1]]);
        self.mesh.triangles.extend(fan);
        for [x, y, z] in tetrahedron.beyond(inside) {
            let [i, j, k] = place.map(|index| index as isize);
            match self.lattice.number([i + x, j + y, k + z]) {
                None => self.mesh.open_at_border += 1,
                Some(number) if self.lattice.value(number).is_none() => self.mesh.open_at_gaps += 1,
                Some(_) => {}
            }
        }
        Ok(())
    }

    /// The vertex on an edge: made when it is needed first.
    fn vertex(&mut self, place: [usize; 3], (a, b): Edge) -> Result<u32, TooManyVertices> {
        // along a path, a corner that comes later has all bits of one before it
        let (low, high) = (a.min(b), a.max(b));
        let [x, y, layer] = steps(low);
        let point = (place[1] + y) * self.lattice.axes[0].len() + place[0] + x;
        let slot = point * EDGES + usize::from(high - low) - 1;
        if self.layers[layer][slot] == NONE {
            let number = u32::try_from(self.mesh.vertices.len()).ok().filter(|&number| number < 1 << 31);
            self.layers[layer][slot] = number.ok_or(TooManyVertices)?;
            let at = |corner| {
                let steps = steps(corner);
                std::array::from_fn(|axis| place[axis] + steps[axis])
            };
            self.mesh.vertices.push(self.interpolated(at(low), at(high)));
        }
        Ok(self.layers[layer][slot])
    }

    /// The vertex between two lattice points.
    fn interpolated(&self, a: [usize; 3], b: [usize; 3]) -> Vertex {
        let value = |place: [usize; 3]| {
            let number = self.lattice.number(place.map(|index| index as isize));
            number.and_then(|number| self.lattice.value(number)).unwrap_or(self.level)
        };
        // halves, because the difference of two values may be more than a number holds
        let (low, high, level) = (0.5 * value(a), 0.5 * value(b), 0.5 * self.level);
        let t = ((level - low) / (high - low)).clamp(NEAREST, 1.0 - NEAREST);
        let between =
            |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|axis| a[axis] + t * (b[axis] - a[axis]));
        let (from, to) = (self.lattice.position(a), self.lattice.position(b));
        let gradient = between(self.lattice.gradient(a), self.lattice.gradient(b));
        let ascent =
            std::array::from_fn(
                |axis| if low < high { to[axis] - from[axis] } else { from[axis] - to[axis] },
            );
        let uphill = unit(gradient).or_else(|| unit(ascent)).unwrap_or([0.0, 0.0, -1.0]);
        Vertex { position: between(from, to), normal: uphill.map(|component| -component) }
    }
}

/// A corner's steps along each axis from the box's lowest corner.
fn steps(corner: u8) -> [usize; 3] {
    [0, 1, 2].map(|axis| usize::from(corner >> axis & 1))
}

/// The direction of a vector; none where it is zero or not finite.
fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let largest = vector.iter().fold(0.0_f64, |most, component| most.max(component.abs()));
    let scaled = vector.map(|component| component / largest);
    let length = scaled.iter().map(|component| component * component).sum::<f64>().sqrt();
    let direction = scaled.map(|component| component / length);
    direction.iter().all(|component| component.is_finite()).then_some(direction)
}
