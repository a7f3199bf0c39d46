//! The patches into which facets are divided: even cells, more and narrower ones towards edges where facets
//! meet in a valley.
//!
//! Near a valley irradiance varies as a power of the distance, often below one. With cell widths proportional
//! to the square root of the distance, so that cell boundaries are at squares, the error of facet means
//! decreases with the square of the number of cells, as it does elsewhere; with widths in a geometric
//! progression it does not.

use std::collections::HashMap;

use crate::geometry::Vec3;
use crate::surfaces::polygon::Polygon;
use crate::surfaces::shape::Shape;

/// Corners nearer to each other than this fraction of the surface's size are equal.
const SAME: f64 = 1e-7;

/// A part of a facet.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its position.
    pub polygon: Polygon,
    /// Its facet.
    pub facet: usize,
}

/// Fineness of the division of facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Division {
    /// Cells along each side of a quadrilateral; a triangle becomes three quadrilaterals unless it is not
    /// divided.
    pub cells: usize,
    /// Whether there are twice as many, and progressively narrower ones, towards a valley.
    pub graded: bool,
}

impl Division {
    /// One patch per facet.
    pub const NONE: Self = Self { cells: 1, graded: false };
}

/// All patches of a surface, facet by facet.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold};
/// use vfold::surfaces::Accordion;
/// use vfold::surfaces::kernel::patches::{Division, patches};
/// let valley = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 2, cols: 2 })?;
/// let v = Accordion { valley, creases: 1, ridge_deg: 60.0, bow_deg: 0.0 }.shape()?;
/// // 8 facets in 2 x 2 cells, 4 of them with twice as many away from the crease
/// assert_eq!(patches(&v, Division { cells: 2, graded: true }).len(), 4 * 4 + 4 * 8);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn patches(shape: &Shape, division: Division) -> Vec<Patch> {
    patches_by(shape, |_| division)
}

/// The same with an individual division of each facet.
#[must_use]
pub fn patches_by(shape: &Shape, division: impl Fn(usize) -> Division) -> Vec<Patch> {
    let valleys = Valleys::new(shape);
    let of_facet = |(facet, polygon): (usize, &Polygon)| {
        let cells = match division(facet) {
            Division::NONE => vec![polygon.clone()],
            division => valleys.divide(facet, polygon, division),
        };
        cells.into_iter().map(move |polygon| Patch { polygon, facet })
    };
    shape.facets().enumerate().flat_map(of_facet).collect()
}

/// Edges at which facets face each other.
struct Valleys {
    unit: f64,
    /// Facets adjacent to an edge, by its rounded ends.
    along_edge: HashMap<[[i64; 3]; 2], Vec<usize>>,
    /// Centroid and normal of every facet.
    sights: Vec<(Vec3, Vec3)>,
}

impl Valleys {
    fn new(shape: &Shape) -> Self {
        let unit = SAME * shape.size();
        let sights = shape.facets().map(|facet| (facet.centroid(), facet.normal())).collect();
        let mut valleys = Self { unit, along_edge: HashMap::new(), sights };
        for (n, facet) in shape.facets().enumerate() {
            for (from, to) in facet.edges() {
                valleys.along_edge.entry(valleys.key(&from, &to)).or_default().push(n);
            }
        }
        valleys
    }

    fn key(&self, from: &Vec3, to: &Vec3) -> [[i64; 3]; 2] {
        let rounded = |point: &Vec3| [point.x, point.y, point.z].map(|x| (x / self.unit).round() as i64);
        let mut ends = [rounded(from), rounded(to)];
        ends.sort_unstable();
        ends
    }

    /// Whether another facet faces this one at an edge.
    fn is_valley(&self, facet: usize, from: &Vec3, to: &Vec3) -> bool {
        let (centroid, normal) = self.sights[facet];
        let faces = |other: &usize| {
            let (far, back) = self.sights[*other];
            let apart = far - centroid;
            let least = 1e-6 * apart.norm();
            apart.dot(&normal) > least && apart.dot(&back) < -least
        };
        self.along_edge.get(&self.key(from, to)).is_some_and(|facets| facets.iter().any(faces))
    }

    fn divide(&self, facet: usize, polygon: &Polygon, division: Division) -> Vec<Polygon> {
        let corners = polygon.corners();
        let is_valley: Vec<bool> =
            polygon.edges().map(|(from, to)| self.is_valley(facet, &from, &to)).collect();
        if let [a, b, c, d] = is_valley[..] {
            return cells(polygon, [a, b, c, d], division);
        }
        let middle = polygon.centroid();
        let third = |n: usize| {
            let [before, corner, after] = [n + 2, n, n + 1].map(|n| corners[n % 3]);
            let quad = Polygon::new(&[corner, 0.5 * (corner + after), middle, 0.5 * (before + corner)]);
            cells(&quad, [is_valley[n], false, false, is_valley[(n + 2) % 3]], division)
        };
        (0..3).flat_map(third).collect()
    }
}

/// A quadrilateral divided into cells, narrower next to those of its sides that are valleys.
fn cells(quad: &Polygon, [low_v, high_u, high_v, low_u]: [bool; 4], division: Division) -> Vec<Polygon> {
    let (us, vs) = (cuts(division, low_u, high_u), cuts(division, low_v, high_v));
    let mut out = Vec::with_capacity(us.len() * vs.len());
    for u in us.windows(2) {
        for v in vs.windows(2) {
            let corner = |u: f64, v: f64| quad.at(u, v).0;
            out.push(Polygon::new(&[
                corner(u[0], v[0]),
                corner(u[1], v[0]),
                corner(u[1], v[1]),
                corner(u[0], v[1]),
            ]));
        }
    }
    out
}

/// Cell boundaries, from 0 to 1, along a side with possible valleys at either end.
fn cuts(Division { cells, graded }: Division, low: bool, high: bool) -> Vec<f64> {
    let (low, high) = (graded && low, graded && high);
    let count = cells << (u32::from(low) + u32::from(high));
    let narrower = |x: f64| match (low, high) {
        (false, false) => x,
        (true, false) => x * x,
        (false, true) => 1.0 - (1.0 - x).powi(2),
        (true, true) if x < 0.5 => 2.0 * x * x,
        (true, true) => 1.0 - 2.0 * (1.0 - x).powi(2),
    };
    (0..=count).map(|n| narrower(n as f64 / count as f64)).collect()
}
