//! Moves corners to the edges in the picture.
//!
//! Light changes along every side of a panel: at the outer sides to the background, at the crease by a step
//! if the panels differ or a kink if they look alike. Each side moves to where that change best explains its
//! pixels ([`super::edge`]), with a covariance, and the corners move to where the sides meet. One least
//! squares problem covers all: even the crease of a dark sheet, hidden by noise, ends where the other sides
//! meet.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::bend::{StraightSide, straightening_lens};
use super::edge::{Edge, EdgeModel, Look, Side, common_blur};
use super::piece::BLURS;
use crate::image::photograph::Photograph;
use crate::image::placing::{Homography, LensEstimate, Point};
use crate::{Error, Result};

/// Position of a panel in the picture, and the corners that it shares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marked {
    /// Its number.
    pub panel: usize,
    /// Its corners, by the order of [`PANEL_CORNERS`](crate::image::PANEL_CORNERS).
    pub corners: [Point; 4],
    /// A number for each corner, from 0 on, equal for a corner shared by several panels.
    pub joints: [usize; 4],
}

/// Corners after refinement.
#[derive(Debug, Clone, PartialEq)]
pub struct Refinement {
    /// Corners of every panel, in the order of the input.
    pub panels: Vec<[Point; 4]>,
    /// How far each was moved, px.
    pub moved_px: Vec<[f64; 4]>,
    /// Sides at which no edge was found: they moved only with their neighbours.
    pub sides_without_edge: Vec<String>,
    /// The lens: as known before, and by the bend of the panels' outer sides.
    pub lens: LensEstimate,
}

/// A side: its name, the corners that it joins, another corner of its panel if there is no sheet beyond it,
/// and whether it is straight however the sheet bows.
struct Ends {
    name: String,
    from: usize,
    to: usize,
    inner: Option<usize>,
    is_straight: bool,
}

/// The sides of a panel from corner to corner.
const SIDES: [&str; 4] = ["crease", "end 1", "outer side", "end 0"];
const OUTER: usize = 2;

/// Each side moves the ends of others, so all are examined again in every round.
const ROUNDS: usize = 6;
/// The lens is determined after these rounds, the last of which follows.
const OF_LENS: [usize; 2] = [1, 3];
/// Each round searches a range this much narrower than the one before, and more finely,
const NEARER: f64 = 0.4;
/// but not narrower than this many standard deviations.
const LEAST_SDS: f64 = 3.0;

/// How far people click from a corner, px.
pub const REFINED_WITHIN_PX: f64 = 6.0;

/// Moves the corners of panels to the edges around them.
///
/// # Arguments
/// - `panels`: their positions in the picture, and the corners that they share.
/// - `lens`: distortion of the picture, as known; the bend of the panels' outer sides adds to it.
/// - `reach_px`: search distance from each stated side, above 0.
///
/// # Errors
/// [`Error::Corners`] for corners that no panel can have, [`Error::Usage`] if two panels place a shared
/// corner differently.
///
/// # Example
/// ```
/// use vfold::image::{LensEstimate, Marked, Photograph, Point, ReadOptions, refine, write_linear};
/// let folder = tempfile::tempdir().unwrap();
/// let path = folder.path().join("card.exr");
/// let card =
///     |k: usize| if (20..80).contains(&(k % 100)) && (30..70).contains(&(k / 100)) { 0.5 } else { 0.0 };
/// let rgb: Vec<f64> = (0..100 * 100).flat_map(|k| [card(k); 3]).collect();
/// write_linear(&path, 100, 100, &rgb)?;
/// let clicked = [(22.0, 28.0), (78.0, 31.0), (81.0, 72.0), (19.0, 69.0)].map(|(x, y)| Point::new(x, y));
/// let clicked = Marked { panel: 0, corners: clicked, joints: [0, 1, 2, 3] };
/// let photograph = Photograph::open(&path, &ReadOptions::default())?;
/// let found = refine(&photograph, &[clicked], &LensEstimate::UNKNOWN, 5.0)?;
/// let corner = found.panels[0][0];
/// assert!((corner.x - 20.0).hypot(corner.y - 30.0) < 0.2, "{corner:?}");
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn refine(
    photograph: &Photograph,
    panels: &[Marked],
    lens: &LensEstimate,
    reach_px: f64,
) -> Result<Refinement> {
    refine_in_sight(photograph, panels, (lens, reach_px), None, f64::INFINITY)
}

/// As [`refine`], with each piece's penalty for a line limited to `most_of_piece`, in log likelihood, because
/// something may hide it; `blur` is the picture's, by number, if known.
pub(in crate::image) fn refine_in_sight(
    photograph: &Photograph,
    panels: &[Marked],
    within: (&LensEstimate, f64),
    blur: Option<usize>,
    most_of_piece: f64,
) -> Result<Refinement> {
    let settled = settle(photograph, panels, within, (ROUNDS, blur), most_of_piece)?;
    let moved = |(from, to): (&Marked, &[Point; 4])| [0, 1, 2, 3].map(|k| from.corners[k].distance(to[k]));
    let sides = sides(panels);
    let without = sides
        .iter()
        .zip(&settled.edges)
        .filter(|(_, edge)| edge.is_none())
        .map(|(side, _)| side.name.clone());
    Ok(Refinement {
        moved_px: panels.iter().zip(&settled.panels).map(moved).collect(),
        sides_without_edge: without.collect(),
        panels: settled.panels,
        lens: settled.lens,
    })
}

/// Panels after refinement, and the edges along their sides: those of the first panel, then those of the
/// others that it does not share, each starting from the crease.
pub(in crate::image) struct Settled {
    /// Corners of every panel, in their input order.
    pub panels: Vec<[Point; 4]>,
    /// Edges within the reach of the original sides.
    pub first_edges: Vec<Option<Edge>>,
    /// Edges at the sides' present positions.
    pub edges: Vec<Option<Edge>>,
    /// Number of the picture's blur; none after no round.
    pub blur: Option<usize>,
    /// The lens.
    pub lens: LensEstimate,
}

/// As [`refine_in_sight`], for this many rounds and with all intermediate results; `blur` is the picture's,
/// by number, if known.
pub(in crate::image) fn settle(
    photograph: &Photograph,
    panels: &[Marked],
    (known_lens, reach_px): (&LensEstimate, f64),
    (rounds, blur): (usize, Option<usize>),
    most_of_piece: f64,
) -> Result<Settled> {
    panels.iter().try_for_each(|panel| Homography::through(known_lens.lens, panel.corners).map(drop))?;
    let joined = joined(panels, reach_px)?;
    let mut lens = *known_lens;
    let mut marked: Vec<Point> = joined.iter().map(|corner| lens.lens.undistort(*corner)).collect();
    let sides = sides(panels);
    let mut corners = marked.clone();
    let mut reaches = vec![reach_px; sides.len()];
    let mut known_blur = blur;
    let (mut first_edges, mut edges) = (Vec::new(), Vec::new());
    for round in 0..rounds {
        let look = |(side, reach): (&Ends, &f64)| {
            let inner = side.inner.map(|corner| corners[corner]);
            // light near a kink bends over a wider range than the lens blurs
            let blurs = match known_blur {
                Some(blur) if inner.is_some() => vec![blur],
                Some(blur) => vec![blur, (blur + 1).min(BLURS - 1)],
                None => (0..BLURS).collect(),
            };
            let side = Side::new(corners[side.from], corners[side.to]);
            side.look(photograph, &lens.lens, *reach, inner, &blurs, most_of_piece)
        };
        let looks: Vec<Look> = sides.par_iter().zip(&reaches).map(look).collect();
        let blur = *known_blur.get_or_insert_with(|| common_blur(&looks));
        edges = looks.iter().map(|look| look.edge(blur)).collect();
        corners = meeting_point(&marked, &corners, &sides, &edges, reach_px);
        for (reach, edge) in reaches.iter_mut().zip(&edges) {
            let nearer = edge.as_ref().map_or(reach_px, |edge| LEAST_SDS * edge.sd_px);
            *reach = nearer.max(NEARER * *reach).min(reach_px);
        }
        if round == 0 {
            first_edges.clone_from(&edges);
        }
        if known_lens.is_uncertain() && OF_LENS.contains(&round) {
            let straight: Vec<StraightSide> =
                sides.iter().filter_map(|side| side.if_straight(&corners)).collect();
            let model = EdgeModel { blur, most_of_piece };
            let (now, bend_px) = straightening_lens(photograph, [known_lens, &lens], &straight, model);
            let seen_anew = |place: &mut Point| *place = now.lens.undistort(lens.lens.distort(*place));
            marked.iter_mut().chain(&mut corners).for_each(seen_anew);
            reaches.iter_mut().for_each(|reach| *reach = reach.max(bend_px));
            lens = now;
        }
    }
    let panels = panels.iter().map(|panel| panel.joints.map(|corner| lens.lens.distort(corners[corner])));
    Ok(Settled { panels: panels.collect(), first_edges, edges, blur: known_blur, lens })
}

impl Ends {
    /// The side as one that a lens alone bends, if it is.
    fn if_straight(&self, corners: &[Point]) -> Option<StraightSide> {
        let inner = self.inner.filter(|_| self.is_straight)?;
        Some(StraightSide { ends: [corners[self.from], corners[self.to]], inner: corners[inner] })
    }
}

/// The sides of panels, a shared one once.
fn sides(panels: &[Marked]) -> Vec<Ends> {
    let mut sides: Vec<Ends> = Vec::new();
    let crease = |panel: &Marked| [panel.joints[0], panel.joints[1]];
    let one_crease = panels.iter().all(|panel| crease(panel) == crease(&panels[0]));
    for (panel, k) in panels.iter().flat_map(|panel| (0..4).map(move |k| (panel, k))) {
        let (from, to) = (panel.joints[k], panel.joints[(k + 1) % 4]);
        let joins =
            |side: &&mut Ends| (side.from, side.to) == (from, to) || (side.to, side.from) == (from, to);
        if let Some(known) = sides.iter_mut().find(joins) {
            known.inner = None;
            continue;
        }
        let of_panel =
            if one_crease && k == 0 { String::new() } else { format!(" of panel {}", panel.panel) };
        let inner = (k != 0).then_some(panel.joints[(k + 2) % 4]);
        let name = format!("{}{of_panel}", SIDES[k]);
        sides.push(Ends { name, from, to, inner, is_straight: k == OUTER });
    }
    sides
}

/// Every corner once, at the mean of its panels' positions for it.
fn joined(panels: &[Marked], reach_px: f64) -> Result<Vec<Point>> {
    let seen = || panels.iter().flat_map(|panel| panel.joints.into_iter().zip(panel.corners));
    let count = seen().map(|(joint, _)| joint + 1).max().unwrap_or(0);
    let place = |joint: usize| {
        let places: Vec<Point> = seen().filter(|(of, _)| *of == joint).map(|(_, place)| place).collect();
        if places.iter().any(|place| place.distance(places[0]) > 2.0 * reach_px) {
            let problem = "a corner shared by two panels is marked in different places";
            let remedy = "mark the same ends of the crease for panels that meet at it";
            return Err(Error::usage("--refine", problem, remedy));
        }
        let mean = |pick: fn(&Point) -> f64| places.iter().map(pick).sum::<f64>() / places.len() as f64;
        Ok(Point::new(mean(|p| p.x), mean(|p| p.y)))
    };
    (0..count).map(place).collect()
}

/// The corners at which the sides meet if they lie along the edges, each weighted by its information; the
/// `marked` corners count as known to within the reach.
fn meeting_point(
    marked: &[Point],
    corners: &[Point],
    sides: &[Ends],
    edges: &[Option<Edge>],
    reach_px: f64,
) -> Vec<Point> {
    let unknowns = 2 * corners.len();
    let unsure = 1.0 / (reach_px * reach_px);
    let mut normal = DMatrix::from_diagonal_element(unknowns, unknowns, unsure);
    let mut right = DVector::from_fn(unknowns, |k, _| {
        let (marked, corner) = (marked[k / 2], corners[k / 2]);
        unsure * if k % 2 == 0 { marked.x - corner.x } else { marked.y - corner.y }
    });
    for (&Ends { from, to, .. }, edge) in sides.iter().zip(edges) {
        let Some(edge) = edge else { continue };
        // moving a corner shifts the side by the component across it
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
    let step = normal.cholesky().map_or_else(|| DVector::zeros(unknowns), |normal| normal.solve(&right));
    let moved = |(k, corner): (usize, &Point)| Point::new(corner.x + step[2 * k], corner.y + step[2 * k + 1]);
    corners.iter().enumerate().map(moved).collect()
}
