//! The surface on which values on a lattice have a level, as triangles.
//!
//! Each box of eight neighbouring lattice points is cut into the six tetrahedra around its diagonal from the lowest to the highest
//! corner. Boxes side by side cut the face between them alike, so that triangles of neighbours meet edge to edge: a surface that
//! reaches neither the border nor a point without value is closed, every edge has exactly two triangles, and every vertex one fan of them.
//! At the border it is open; at points without value it has holes, whose rims may touch in a vertex.
//!
//! A vertex lies on an edge of a tetrahedron, from lattice point a to b, where the linear interpolation of the values has the level:
//!
//! ```text
//! t = (L − A_a) / (A_b − A_a),   x = x_a + t (x_b − x_a),   n = −g / |g|,   g = g_a + t (g_b − g_a)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | L, A | the level; the value at a lattice point | of the values |
//! | x | place of a lattice point, or of the vertex | of the lattice |
//! | g | gradient at a lattice point | of values over lengths |
//! | n | normal of the vertex, from high values to low ones | 1 |
//!
//! t is kept between 1/1024 and 1023/1024, so that the vertices around a lattice point with the value L are not at one place.
//!
//! Source: A. Doi, A. Koide, *An efficient method of triangulating equi-valued surfaces by using tetrahedral cells*, IEICE
//! Transactions E74 (1991); the six tetrahedra: H. Freudenthal, *Simplizialzerlegungen von beschränkter Flachheit*, Annals of
//! Mathematics 43 (1942).

mod lattice;
mod march;
#[cfg(test)]
mod tests;
mod tetrahedron;

pub use lattice::Lattice;
pub use march::march;

use thiserror::Error;

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is, in the lattice's unit of length.
    pub position: [f64; 3],
    /// The normal, of length 1: it points from high values to low ones.
    pub normal: [f64; 3],
}

/// Triangles that share vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The vertices, in the order in which boxes of the lattice need them; the first axis runs fastest.
    pub vertices: Vec<Vertex>,
    /// The numbers of three vertices each, from 0, counter-clockwise where the low values are in front.
    pub triangles: Vec<[u32; 3]>,
    /// Edges with one triangle because the lattice ends there.
    pub open_at_border: usize,
    /// Edges with one triangle because the next lattice point has no value.
    pub open_at_gaps: usize,
}

impl Mesh {
    /// How many edges there are; an edge that two triangles share counts once.
    #[must_use]
    pub fn edges(&self) -> usize {
        (3 * self.triangles.len() + self.open_at_border + self.open_at_gaps) / 2
    }
}

/// A surface has more vertices than 31 bits count, which is what files hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the surface has more than 2³¹ vertices")]
pub struct TooManyVertices;
