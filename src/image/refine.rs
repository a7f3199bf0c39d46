//! Corners moved to where the picture has edges.
//!
//! Along every side of the panels the light changes: at the outer sides to the background, at the crease by a step, where the
//! panels differ, or by a kink, where they are alike. Each side is moved to where that change explains its pixels best
//! ([`super::edge`]), with a covariance that says how well it is known, and the corners to where the sides meet. All is one least
//! squares problem: the crease of a dark sheet, which noise hides, still ends where the other sides meet.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::distortion::Lens;
use super::edge::{Edge, Side};
use super::homography::Point;
use super::photograph::Photograph;
use crate::{Error, Result};

/// Corners after refinement.
#[derive(Debug, Clone, PartialEq)]
pub struct Refinement {
    /// Corners of every panel, in the order in which they were given.
    pub panels: Vec<[Point; 4]>,
    /// How far each was moved, px.
    pub moved_px: Vec<[f64; 4]>,
    /// Sides at which no edge was found: they were left where they are, but for what their neighbours tell.
    pub sides_without_edge: Vec<&'static str>,
}

/// A side: its name and the corners that it joins.
type Ends = (&'static str, usize, usize);

/// The crease, by the corners it joins.
const CREASE: (usize, usize) = (0, 1);
/// The sides of one panel and of two.
const SIDES: [Ends; 7] = [
    ("crease", 0, 1),
    ("end 1 of panel 0", 1, 2),
    ("outer side of panel 0", 2, 3),
    ("end 0 of panel 0", 3, 0),
    ("end 1 of panel 1", 1, 4),
    ("outer side of panel 1", 4, 5),
    ("end 0 of panel 1", 5, 0),
];
/// Which of the six corners are those of a panel.
const PANELS: [[usize; 4]; 2] = [[0, 1, 2, 3], [0, 1, 4, 5]];

/// What is found at one side moves the ends of others, so that they are looked at again.
const ROUNDS: usize = 6;
/// Each round looks this much nearer than the one before, and more finely,
const NEARER: f64 = 0.4;
/// but not nearer than this many standard deviations.
const LEAST_SDS: f64 = 3.0;
/// How exactly a step is where the model of an edge has it, px, and a kink: light curves on both sides of a crease.
const STEP_SD_PX: f64 = 0.015;
const KINK_SD_PX: f64 = 0.5;

/// Moves the corners of one panel or two to the edges around them.
///
/// # Arguments
/// - `panels`: corners by the order of [`PANEL_CORNERS`](super::PANEL_CORNERS); those of two panels share the crease.
/// - `lens`: what bends the picture.
/// - `reach_px`: how far from a given side an edge is looked for, above 0.
///
/// # Errors
/// [`Error::Usage`] if there are not one or two panels, or the two do not meet at a crease.
///
/// # Example
/// ```
/// use vfold::image::{Lens, Photograph, Point, ReadOptions, refine, write_linear};
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("card.exr");
/// let card = |k: usize| if (20..80).contains(&(k % 100)) && (30..70).contains(&(k / 100)) { 0.5 } else { 0.0 };
/// let rgb: Vec<f64> = (0..100 * 100).flat_map(|k| [card(k); 3]).collect();
/// write_linear(&path, 100, 100, &rgb)?;
/// let clicked = [(22.0, 28.0), (78.0, 31.0), (81.0, 72.0), (19.0, 69.0)].map(|(x, y)| Point::new(x, y));
/// let found = refine(&Photograph::open(&path, &ReadOptions::default())?, &[clicked], &Lens::STRAIGHT, 5.0)?;
/// let corner = found.panels[0][0];
/// assert!((corner.x - 20.0).hypot(corner.y - 30.0) < 0.2, "{corner:?}");
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn refine(
    photograph: &Photograph,
    panels: &[[Point; 4]],
    lens: &Lens,
    reach_px: f64,
) -> Result<Refinement> {
    let given = joined(panels, reach_px)?.map(|corner| lens.undistort(corner));
    let sides = if panels.len() == 1 { &SIDES[..4] } else { &SIDES };
    let (corners, edges) = settle(photograph, &given, sides, lens, reach_px);
    let seen = corners.map(|corner| lens.distort(corner));
    let refined: Vec<[Point; 4]> =
        PANELS[..panels.len()].iter().map(|panel| panel.map(|corner| seen[corner])).collect();
    let moved = |(from, to): (&[Point; 4], &[Point; 4])| [0, 1, 2, 3].map(|k| from[k].distance(to[k]));
    let without = sides.iter().zip(&edges).filter(|(_, edge)| edge.is_none()).map(|((name, ..), _)| *name);
    Ok(Refinement {
        moved_px: panels.iter().zip(&refined).map(moved).collect(),
        sides_without_edge: without.collect(),
        panels: refined,
    })
}

/// Corners and edges after all rounds.
fn settle(
    photograph: &Photograph,
    given: &[Point; 6],
    sides: &[Ends],
    lens: &Lens,
    reach_px: f64,
) -> ([Point; 6], Vec<Option<Edge>>) {
    let mut corners = *given;
    let mut reaches = vec![reach_px; sides.len()];
    let mut edges = Vec::new();
    for _ in 0..ROUNDS {
        let find = |((_, from, to), reach): (&Ends, &f64)| {
            let model_sd_px = if (*from, *to) == CREASE { KINK_SD_PX } else { STEP_SD_PX };
            Side::new(corners[*from], corners[*to]).edge(photograph, lens, *reach, model_sd_px)
        };
        edges = sides.par_iter().zip(&reaches).map(find).collect::<Vec<_>>();
        corners = meeting_point(given, &corners, sides, &edges, reach_px);
        for (reach, edge) in reaches.iter_mut().zip(&edges) {
            let nearer = edge.as_ref().map_or(reach_px, |edge| LEAST_SDS * edge.sd_px);
            *reach = nearer.max(NEARER * *reach).min(reach_px);
        }
    }
    (corners, edges)
}

/// The corners of both panels, each once; of one panel, with two corners that no side joins.
fn joined(panels: &[[Point; 4]], reach_px: f64) -> Result<[Point; 6]> {
    let (a, b) = match panels {
        [only] => (only, only),
        [a, b] => (a, b),
        _ => return Err(Error::usage("--refine", "there are more than two panels", "give one or two")),
    };
    if (0..2).any(|k| a[k].distance(b[k]) > 2.0 * reach_px) {
        let problem = "the panels' crease ends are not the same points";
        return Err(Error::usage("--refine", problem, "give both panels the same first two corners"));
    }
    let middle = |k: usize| Point::new((a[k].x + b[k].x) / 2.0, (a[k].y + b[k].y) / 2.0);
    Ok([middle(0), middle(1), a[2], a[3], b[2], b[3]])
}

/// Where the corners are if the sides lie as the edges say, each weighted by what is known of it; the `given` corners count as
/// known to within the reach.
fn meeting_point(
    given: &[Point; 6],
    corners: &[Point; 6],
    sides: &[Ends],
    edges: &[Option<Edge>],
    reach_px: f64,
) -> [Point; 6] {
    let unsure = 1.0 / (reach_px * reach_px);
    let mut normal = DMatrix::from_diagonal_element(12, 12, unsure);
    let mut right = DVector::from_fn(12, |k, _| {
        let (given, corner) = (given[k / 2], corners[k / 2]);
        unsure * if k % 2 == 0 { given.x - corner.x } else { given.y - corner.y }
    });
    for (&(_, from, to), edge) in sides.iter().zip(edges) {
        let Some(edge) = edge else { continue };
        // a corner's move shifts the side by its part across it
        let across = Side::new(corners[from], corners[to]).across();
        for (i, corner) in [from, to].into_iter().enumerate() {
            let mut pull = right.fixed_rows_mut::<2>(2 * corner);
            pull += across * edge.pull[i];
            for (j, other) in [from, to].into_iter().enumerate() {
                let mut information = normal.fixed_view_mut::<2, 2>(2 * corner, 2 * other);
                information += across * across.transpose() * edge.information[(i, j)];
            }
        }
    }
    let step = normal.cholesky().map_or_else(|| DVector::zeros(12), |normal| normal.solve(&right));
    std::array::from_fn(|k| Point::new(corners[k].x + step[2 * k], corners[k].y + step[2 * k + 1]))
}
