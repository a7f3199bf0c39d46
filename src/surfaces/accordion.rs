//! Folds with several creases, and panels curved like the pages of an open book.

use super::{Group, Shape};
use crate::error::{Error, Result};
use crate::geometry::{FacetGrid, Fold};

/// Most creases.
const CREASES_MAX: usize = 1000;

/// A sheet creased several times, valleys and ridges alternating, with flat or curved panels.
///
/// The V of [`Fold`] is the accordion of one crease.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accordion {
    /// Opening angle of the valleys, facets and sizes of the panels: those with even numbers have the depth
    /// of panel 0.
    pub valley: Fold,
    /// Number of creases, one less than panels.
    pub creases: usize,
    /// Angle between two panels at a ridge, on the back of the reflecting side, degrees in (0, 180].
    pub ridge_deg: f64,
    /// Angle by which a panel turns away from the other between its valley and its other end, along a
    /// circular arc, degrees in (−180, 180); negative values make a trough.
    pub bow_deg: f64,
}

impl Accordion {
    /// The surface. Panels are groups `panel 0`, … from left to right; facets are ordered by panel, then by
    /// row outwards from the valley, then by column along y. Valleys open towards z; a curved panel has one
    /// flat strip per row.
    ///
    /// # Errors
    /// No crease or too many, an angle out of range, too many facets, or panels that intersect.
    ///
    /// # Example
    /// ```
    /// use vfold::geometry::{FacetGrid, Fold};
    /// use vfold::surfaces::Accordion;
    /// let valley = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 6, cols: 6 })?;
    /// let w = Accordion { valley, creases: 3, ridge_deg: 100.0, bow_deg: 0.0 }.shape()?;
    /// assert_eq!((w.groups().len(), w.len()), (4, 144));
    /// assert!(w.facet(0).normal().x > 0.98); // the left panel leans back, the light comes along z
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn shape(&self) -> Result<Shape> {
        self.check()?;
        let profiles = self.profiles();
        if let Some([one, other]) = crossing(&profiles) {
            let problem = format!("panels {one} and {other} pass through each other");
            let flag = if self.bow_deg == 0.0 { "--ridge-deg" } else { "--bow-deg" };
            return Err(Error::usage(
                flag,
                problem,
                "open --angle-deg or --ridge-deg, or bend the panels less",
            ));
        }
        let FacetGrid { rows, cols } = self.valley.facets();
        let width = self.valley.width();
        let (mut vertices, mut faces, mut groups) = (Vec::new(), Vec::new(), Vec::new());
        for (panel, profile) in profiles.iter().enumerate() {
            let (first, first_face) = (vertices.len(), faces.len());
            for [x, z] in profile {
                let y = |col: usize| width * (col as f64 / cols as f64 - 0.5);
                vertices.extend((0..=cols).map(|col| [*x, y(col), *z]));
            }
            let at = |row: usize, col: usize| first + row * (cols + 1) + col;
            for (row, col) in (0..rows).flat_map(|row| (0..cols).map(move |col| (row, col))) {
                let mut corners =
                    vec![at(row, col), at(row, col + 1), at(row + 1, col + 1), at(row + 1, col)];
                if !panel.is_multiple_of(2) {
                    corners.reverse();
                }
                faces.push(corners);
            }
            groups.push(Group { name: format!("panel {panel}"), facets: first_face..faces.len() });
        }
        Shape::new(vertices, faces, groups).map(|(shape, _)| shape)
    }

    fn check(&self) -> Result<()> {
        if !(1..=CREASES_MAX).contains(&self.creases) {
            let problem = format!("{} is not a number of creases", self.creases);
            return Err(Error::usage("--folds", problem, format!("give 1 to {CREASES_MAX}")));
        }
        if !(self.ridge_deg > 0.0 && self.ridge_deg <= 180.0) {
            let problem = format!("{} is not an angle between two panels", self.ridge_deg);
            return Err(Error::usage("--ridge-deg", problem, "give degrees above 0 and up to 180 (flat)"));
        }
        if self.bow_deg.is_nan() || self.bow_deg.abs() >= 180.0 {
            let problem = format!("{} is out of range", self.bow_deg);
            return Err(Error::usage("--bow-deg", problem, "give degrees between -180 and 180"));
        }
        Ok(())
    }

    /// Points (x, z) at the boundaries of the rows of every panel, outwards from the valley.
    fn profiles(&self) -> Vec<Vec<[f64; 2]>> {
        let (mut at, mut heading) = ([0.0; 2], 0.0);
        let mut profiles = Vec::new();
        for panel in 0..=self.creases {
            let mut profile = self.walk(panel, &mut at, &mut heading);
            let (angle_deg, turn) =
                if panel.is_multiple_of(2) { (self.valley.angle_deg(), 1.0) } else { (self.ridge_deg, -1.0) };
            heading += turn * (180.0 - angle_deg).to_radians();
            if panel.is_multiple_of(2) {
                profile.reverse();
            }
            profiles.push(profile);
        }
        level(&mut profiles, at);
        profiles
    }

    /// The rows of a panel from left to right: down to the valley on even panels, up from it on odd ones.
    /// Returns its boundaries and moves to the panel's end.
    fn walk(&self, panel: usize, at: &mut [f64; 2], heading: &mut f64) -> Vec<[f64; 2]> {
        let mut edges = self.valley.row_edges()[panel % 2].clone();
        let depth = edges[edges.len() - 1];
        if panel.is_multiple_of(2) {
            edges = edges.iter().rev().map(|edge| depth - edge).collect();
        }
        // seen from the left, pages turn right both before and after the valley
        let turn = -self.bow_deg.to_radians() / depth;
        let mut profile = vec![*at];
        for row in edges.windows(2) {
            let length = row[1] - row[0];
            let half = 0.5 * turn * length;
            let chord = if half == 0.0 { length } else { length * half.sin() / half };
            *heading += half;
            *at = [at[0] + chord * heading.cos(), at[1] + chord * heading.sin()];
            *heading += half;
            profile.push(*at);
        }
        profile
    }
}

/// The first two panels that intersect, if any. Touching is allowed.
fn crossing(profiles: &[Vec<[f64; 2]>]) -> Option<[usize; 2]> {
    let extents: Vec<[[f64; 2]; 2]> = profiles.iter().map(|profile| extent(profile)).collect();
    let apart = |a: usize, b: usize| {
        (0..2).any(|axis| {
            extents[a][1][axis] < extents[b][0][axis] || extents[b][1][axis] < extents[a][0][axis]
        })
    };
    let cross = |a: usize, b: usize| {
        profiles[a].windows(2).any(|one| profiles[b].windows(2).any(|other| strips_cross(one, other)))
    };
    (0..profiles.len()).flat_map(|b| (0..b).map(move |a| [a, b])).find(|&[a, b]| !apart(a, b) && cross(a, b))
}

/// Least and greatest coordinates.
fn extent(profile: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let axis = |axis: usize| profile.iter().map(move |point| point[axis]);
    [
        [0, 1].map(|a| axis(a).fold(f64::INFINITY, f64::min)),
        [0, 1].map(|a| axis(a).fold(f64::NEG_INFINITY, f64::max)),
    ]
}

/// Whether each strip has its ends on different sides of the other.
fn strips_cross(one: &[[f64; 2]], other: &[[f64; 2]]) -> bool {
    let side = |line: &[[f64; 2]], point: [f64; 2]| {
        let [along, to] = [line[1], point].map(|end| [end[0] - line[0][0], end[1] - line[0][1]]);
        along[0] * to[1] - along[1] * to[0]
    };
    let parted = |line: &[[f64; 2]], ends: &[[f64; 2]]| side(line, ends[0]) * side(line, ends[1]) < 0.0;
    parted(one, other) && parted(other, one)
}

/// Rotates the profile so that its ends, the origin and `end`, are at equal height, and moves the midpoint
/// between them and the lowest point to 0.
fn level(profiles: &mut [Vec<[f64; 2]>], end: [f64; 2]) {
    let length = end[0].hypot(end[1]);
    let (cos, sin) = (end[0] / length, end[1] / length);
    let turned = |[x, z]: [f64; 2]| [x * cos + z * sin - 0.5 * length, z * cos - x * sin];
    profiles.iter_mut().flatten().for_each(|point| *point = turned(*point));
    let lowest = profiles.iter().flatten().map(|point| point[1]).fold(f64::INFINITY, f64::min);
    profiles.iter_mut().flatten().for_each(|point| point[1] -= lowest);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn accordion(creases: usize, bow_deg: f64) -> Accordion {
        let valley = Fold::new(60.0, 1.0, 1.0, FacetGrid { rows: 4, cols: 2 }).unwrap();
        Accordion { valley, creases, ridge_deg: 100.0, bow_deg }
    }

    #[test]
    fn one_crease_is_the_v_of_the_tilted_sun() {
        let shape = accordion(1, 0.0).shape().unwrap();
        for tilt_deg in [0.0_f64, 20.0] {
            let (sin, cos) = tilt_deg.to_radians().sin_cos();
            let sun = crate::geometry::Vec3::new(sin, 0.0, cos);
            let light = crate::geometry::Light::new(&accordion(1, 0.0).valley, tilt_deg, 0.0, 0.0).unwrap();
            assert!((shape.facet(0).normal().dot(&sun) - light.panel_irradiance()[0]).abs() < 1e-14);
            assert!((shape.facet(8).normal().dot(&sun) - light.panel_irradiance()[1]).abs() < 1e-14);
        }
    }

    #[test]
    fn panels_meet_at_creases_and_keep_their_depth() {
        for (creases, bow_deg) in [(1, 0.0), (3, 0.0), (4, 0.0), (1, 50.0), (3, -30.0)] {
            let shape = accordion(creases, bow_deg).shape().unwrap();
            let area: f64 = shape.facets().map(super::super::Polygon::area).sum();
            assert!(area <= (creases + 1) as f64 + 1e-12 && area > 0.98 * (creases + 1) as f64);
            let profiles = accordion(creases, bow_deg).profiles();
            for valley in profiles.chunks_exact(2) {
                assert!((valley[0][0][0] - valley[1][0][0]).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn panels_do_not_pass_through_each_other() {
        let valley = Fold::new(20.0, 1.0, 1.0, FacetGrid { rows: 3, cols: 2 }).unwrap();
        let shape = |creases, ridge_deg, bow_deg| Accordion { valley, creases, ridge_deg, bow_deg }.shape();
        // each panel's chord leans by half the bow: a trough closes when this reaches half the angle
        assert!(shape(1, 90.0, -19.0).is_ok());
        let closed = shape(1, 90.0, -21.0).unwrap_err().to_string();
        assert!(closed.starts_with("--bow-deg: panels 0 and 1 pass through"), "{closed}");
        // at a ridge it is the open book that closes
        assert!(shape(2, 30.0, 29.0).is_ok());
        assert!(shape(2, 30.0, 31.0).unwrap_err().to_string().contains("and 2 pass through"));
        assert!(shape(40, 20.0, 0.0).is_ok());
        assert!(shape(40, 40.0, 0.0).unwrap_err().to_string().starts_with("--ridge-deg: panels"));
    }

    /// The pages of a book leave the gutter steeply and then flatten out: both ends are lower than those of a
    /// flat V.
    #[test]
    fn a_positive_bow_is_an_open_book() {
        let height = |bow_deg: f64| accordion(1, bow_deg).profiles()[1][4][1];
        assert!(height(60.0) < height(0.0) - 0.1 && height(-30.0) > height(0.0));
    }
}
