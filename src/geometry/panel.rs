//! Panels: flat quadrilaterals divided into rows and columns of facets, as photographs show them.

use std::ops::Range;

use super::{Fold, Vec3};

/// Points closer than this fraction of a panel count as one.
const SAME: f64 = 1e-6;

/// A flat quadrilateral divided into rows and columns of facets, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Its corners: crease end 0, crease end 1, outer end 1, outer end 0.
    pub corners: [Vec3; 4],
    /// Row boundaries, from 0 at the crease to 1.
    pub row_edges: Vec<f64>,
    /// Column boundaries along the crease, from 0 to 1.
    pub col_edges: Vec<f64>,
    /// Range of its facets among those of the scene.
    pub facets: Range<usize>,
}

impl Fold {
    /// Both panels in space. The crease lies on the y axis with its middle at the origin, the bisecting plane
    /// is x = 0, the fold opens towards +z, and panel 0 has negative x.
    #[must_use]
    pub fn panels(&self) -> [Panel; 2] {
        let (sin, cos) = (self.angle_rad() / 2.0).sin_cos();
        let (count, cols) = (self.facets().len(), self.facets().cols);
        [0, 1].map(|panel: usize| {
            let side = if panel == 0 { -sin } else { sin };
            let out = self.depths()[panel] * Vec3::new(side, 0.0, cos);
            let [end_0, end_1] = [-0.5, 0.5].map(|end| Vec3::new(0.0, end * self.width(), 0.0));
            Panel {
                corners: [end_0, end_1, end_1 + out, end_0 + out],
                row_edges: self.spacing().edges(self.facets().rows),
                col_edges: (0..=cols).map(|edge| edge as f64 / cols as f64).collect(),
                facets: panel * count..(panel + 1) * count,
            }
        })
    }
}

impl Panel {
    /// The panel that these facets form row by row, numbered from `first`; `None` if they do not form one.
    ///
    /// Rows and columns follow the order of the facets. A single strip is a row if neighbours share the side
    /// between the second and third corner of the first facet, else a column, as in accordions.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{Panel, Vec3};
    /// let square =
    ///     |x: f64| [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    /// let panel = Panel::of_facets(&[square(0.0), square(1.0)], 0).unwrap();
    /// assert_eq!((panel.row_edges, panel.col_edges), (vec![0.0, 1.0], vec![0.0, 0.5, 1.0]));
    /// assert_eq!(Panel::of_facets(&[square(0.0), square(1.0), square(3.0)], 0), None);
    /// ```
    #[must_use]
    pub fn of_facets(quads: &[[Vec3; 4]], first: usize) -> Option<Self> {
        let cols = columns(quads)?;
        let (last, directions) = (quads.len() - 1, directions(quads, cols)?);
        let at = |facet: usize, ends: [f64; 2]| corner(&quads[facet], directions, ends);
        let corners = [
            at(0, [-1.0, -1.0]),
            at(cols - 1, [1.0, -1.0]),
            at(last, [1.0, 1.0]),
            at(last + 1 - cols, [-1.0, 1.0]),
        ];
        let (along, out) = (corners[1] - corners[0], corners[3] - corners[0]);
        let [u, v] = dual(along, out)?;
        let col_edge = |facet: usize| u.dot(&(at(facet, [1.0, -1.0]) - corners[0]));
        let row_edge = |facet: usize| v.dot(&(at(facet, [-1.0, 1.0]) - corners[0]));
        let panel = Self {
            corners,
            row_edges: [0.0].into_iter().chain((0..=last).step_by(cols).map(row_edge)).collect(),
            col_edges: [0.0].into_iter().chain((0..cols).map(col_edge)).collect(),
            facets: first..first + quads.len(),
        };
        let is_even = |k: usize| {
            let (row, col) = (k / cols, k % cols);
            [[0, 0], [0, 1], [1, 0], [1, 1]].into_iter().all(|[right, down]| {
                let place =
                    corners[0] + along * panel.col_edges[col + right] + out * panel.row_edges[row + down];
                let seen = at(k, [right, down].map(|end| if end == 1 { 1.0 } else { -1.0 }));
                (place - seen).norm() < SAME * along.norm().max(out.norm())
            })
        };
        (last == 0 || (0..=last).all(is_even)).then_some(panel)
    }
}

/// Number of facets in a row: those side by side, starting with the first.
fn columns(quads: &[[Vec3; 4]]) -> Option<usize> {
    let first = quads.first()?;
    let size = (first[2] - first[0]).norm();
    let is_in = |p: &Vec3, quad: &[Vec3; 4]| quad.iter().any(|q| (p - q).norm() < SAME * size);
    let apart = |pair: &[[Vec3; 4]]| pair[0].iter().filter(|p| is_in(p, &pair[1])).count() < 2;
    let cols = match (quads.windows(2).position(apart), quads.get(1)) {
        (Some(last), _) => last + 1,
        (None, Some(second)) if !(is_in(&first[1], second) && is_in(&first[2], second)) => 1,
        (None, _) => quads.len(),
    };
    quads.len().is_multiple_of(cols).then_some(cols)
}

/// Vectors from the first facet to the next in its row and to the first of the next row; where there is none,
/// along one of its own sides.
fn directions(quads: &[[Vec3; 4]], cols: usize) -> Option<[Vec3; 2]> {
    let middle = |quad: &[Vec3; 4]| quad.iter().sum::<Vec3>() / 4.0;
    let to = |facet: usize| quads.get(facet).map(|quad| middle(quad) - middle(&quads[0]));
    let [p, q, r, s] = quads.first()?;
    let other = |known: Vec3| {
        let turned = |side: &Vec3| known.cross(side).norm() / side.norm();
        if turned(&(q - p)) > turned(&(r - q)) { q - p } else { r - q }
    };
    Some(match (to(1).filter(|_| cols > 1), to(cols)) {
        (Some(along), Some(out)) => [along, out],
        (Some(along), None) => [along, other(along)],
        (None, Some(out)) => [other(out), out],
        (None, None) => [q - p, s - p],
    })
}

/// The corner of a facet furthest along each direction, or against it where `ends` is -1.
fn corner(quad: &[Vec3; 4], [along, out]: [Vec3; 2], ends: [f64; 2]) -> Vec3 {
    let [u, v] = dual(along, out).unwrap_or([along, out]);
    let reach = |point: &&Vec3| ends[0] * u.dot(point) + ends[1] * v.dot(point);
    quad.iter().max_by(|a, b| reach(a).total_cmp(&reach(b))).copied().unwrap_or_default()
}

/// Vectors whose dot products with a point of the plane are its coordinates along `a` and `b`; `None` if
/// these are parallel.
fn dual(a: Vec3, b: Vec3) -> Option<[Vec3; 2]> {
    let normal = a.cross(&b);
    let area = normal.norm_squared();
    (area > 0.0).then(|| [b.cross(&normal) / area, normal.cross(&a) / area])
}

/// For every panel the numbers of its four corners, corners at the same place sharing a number.
///
/// # Example
/// ```
/// use vfold::geometry::{FacetGrid, Fold, joints};
/// let fold = Fold::new(45.0, 1.0, 1.0, FacetGrid { rows: 10, cols: 10 })?;
/// assert_eq!(joints(&fold.panels()), [[0, 1, 2, 3], [0, 1, 4, 5]]);
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn joints<'a>(panels: impl IntoIterator<Item = &'a Panel>) -> Vec<[usize; 4]> {
    let mut places: Vec<Vec3> = Vec::new();
    let mut number = |place: &Vec3, size: f64| {
        let known = places.iter().position(|known| (known - place).norm() < SAME * size);
        known.unwrap_or_else(|| {
            places.push(*place);
            places.len() - 1
        })
    };
    let size = |panel: &Panel| (panel.corners[2] - panel.corners[0]).norm();
    panels.into_iter().map(|panel| panel.corners.each_ref().map(|place| number(place, size(panel)))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{FacetGrid, Spacing};

    /// The facets of a panel, each with its corners starting anywhere and in either orientation.
    fn facets(panel: &Panel, turn: usize, mirrored: bool) -> Vec<[Vec3; 4]> {
        let [p, q, _, s] = panel.corners;
        let facet = |rows: &[f64], cols: &[f64]| {
            let at = |u: f64, v: f64| p + (q - p) * u + (s - p) * v;
            let mut quad =
                [at(cols[0], rows[0]), at(cols[1], rows[0]), at(cols[1], rows[1]), at(cols[0], rows[1])];
            quad.rotate_left(turn);
            if mirrored {
                quad.reverse();
            }
            quad
        };
        let rows = panel.row_edges.windows(2);
        rows.flat_map(|rows| panel.col_edges.windows(2).map(move |cols| facet(rows, cols))).collect()
    }

    #[test]
    fn facets_tell_their_panel() {
        for (rows, cols) in [(3, 4), (2, 2), (5, 1), (1, 4), (1, 1)] {
            let fold =
                Fold::new(50.0, 2.0, 1.0, FacetGrid { rows, cols }).unwrap().with_spacing(Spacing::Graded);
            for (panel, turn) in fold.panels().iter().zip([0, if rows > 1 && cols > 1 { 3 } else { 0 }]) {
                let quads = facets(panel, turn, panel.facets.start > 0);
                let found = Panel::of_facets(&quads, panel.facets.start).unwrap();
                assert_eq!((found.facets.clone(), found.row_edges.len()), (panel.facets.clone(), rows + 1));
                let off =
                    |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(off(&found.row_edges, &panel.row_edges) < 1e-12 || rows == 1);
                assert!(off(&found.col_edges, &panel.col_edges) < 1e-12);
                let corners = found.corners.iter().zip(&panel.corners);
                assert!(rows == 1 || cols == 1 || corners.map(|(a, b)| (a - b).norm()).sum::<f64>() < 1e-12);
            }
        }
    }
}
