//! Locates a fold in a photograph, with a confidence.
//!
//! A fold is two quadrilaterals with a common side. Its physics distinguishes it from two other things that
//! touch: each panel is one sheet of one colour, its light rises smoothly to the crease (or falls, under an
//! overcast sky), both look alike there, and edges surround them. All six corners are found together:
//!
//! 1. [`reduced`], [`plane`], [`evidence`]: a reduced copy, and steps and ridges of light in all its
//!    channels;
//! 2. [`chains`], [`segments`]: straight edges and ridges;
//! 3. [`quads`], [`pairs`], [`snap`]: quadrilaterals on them, pairs of these, and variants with other
//!    creases;
//! 4. [`light`], [`score`], [`search`]: the most probable of these against "no fold", a logit over their
//!    features;
//! 5. [`candidates`], [`trust`]: the best ones refined, and the probability that all corners are right.
//!
//! The fold that is most probably right is then refined at full resolution. [`chart`] finds colour charts by
//! other means, [`white`] what may be white paper or a card.

mod candidates;
mod chains;
mod chart;
mod evidence;
mod features;
mod light;
mod outline;
mod pairs;
mod plane;
mod quads;
mod reduced;
mod score;
mod search;
mod segments;
mod snap;
#[cfg(test)]
mod synthetic;
mod tree;
mod trust;
mod weights;
mod white;

use super::edges::{MOST_OF_PIECE, refine_in_sight};
use super::photograph::Photograph;
use super::placing::{LensEstimate, Point};
use candidates::{Candidate, candidates};
pub use chart::{DetectedChart, find_chart, weighed_chart};
use outline::{Outline, Place};
use reduced::Reduced;
use trust::confidence;
use white::white_areas;

/// A fold in a photograph.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DetectedFold {
    /// Corners of panels 0 and 1, px of the upright picture, in the order of
    /// [`PANEL_CORNERS`](crate::image::PANEL_CORNERS). If the crease is upright, end 0 is at the bottom and
    /// panel 0 on the left; if it is level, panel 0 is the lower one.
    pub panels: [[Point; 4]; 2],
    /// The lens: as known before, and by the bend of the panels' outer sides.
    pub lens: LensEstimate,
    /// Probability that all six corners are within 3 % of a panel's side of their true positions.
    pub confidence: f64,
}

impl DetectedFold {
    /// From this confidence on a fold is measured without review: among pictures left out of the fit, none at
    /// or above it was wrong.
    pub const SURE: f64 = 0.97;

    /// Whether it may be measured without review.
    #[must_use]
    pub fn is_sure(&self) -> bool {
        self.confidence >= Self::SURE
    }

    /// Says that a fold was found with this confidence, which is not enough.
    #[must_use]
    pub fn unsure(confidence: f64) -> String {
        let [found, needed] = [(100.0 * confidence).floor(), 100.0 * Self::SURE];
        format!("the fold was found with only {found:.0} % confidence ({needed:.0} % needed)")
    }
}

/// The reason why no fold was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoFold {
    /// Nothing resembles one.
    #[error("nothing in the picture looks like a whole fold")]
    Nothing,
    /// One seems to continue beyond the picture.
    #[error("the fold is cut by the edge of the picture")]
    Cut,
}

/// Guesses below this confidence are not shown.
const LEAST_CONFIDENCE: f64 = 0.1;
/// A corner further beyond the edge of the reduced picture, px, is outside it.
const BEYOND_PX: f64 = 0.5;
/// An unsure fold with a corner this near to the edge, px, may continue beyond it.
const AT_EDGE_PX: f64 = 3.0;
/// Search distance for edges at full resolution: as many px plus as many pixels of the reduced picture, and
/// its minimum.
const REACH_PX: f64 = 2.0;
const LEAST_REACH_PX: f64 = 4.0;

/// Finds the fold in a photograph.
///
/// # Arguments
/// - `lens`: distortion of the picture, as known.
///
/// # Errors
/// [`NoFold`] if there is not even a guess.
///
/// # Example
/// ```
/// use vfold::image::{LensEstimate, NoFold, Photograph, find_fold};
/// // on a dark table, a sheet with a level crease, which is brighter there and more of its colour
/// let lit = |reflectance: f32, y: usize| {
///     reflectance * (0.5 + reflectance * (-(y as f32 + 0.5 - 100.0).abs() / 30.0).exp())
/// };
/// let inside = |x: usize, y: usize| (60..180).contains(&x) && (40..160).contains(&y);
/// let light =
///     |x, y| [0.7, 0.5, 0.3].map(|reflectance| if inside(x, y) { lit(reflectance, y) } else { 0.1 });
/// let light = (0..240 * 200).flat_map(|k| light(k % 240, k / 240)).collect();
/// let found = find_fold(&Photograph::from_light(240, 200, light)?, &LensEstimate::UNKNOWN).unwrap();
/// let [x, y] = [found.panels[0][2].x, found.panels[0][2].y]; // outer end 1 of the lower panel
/// assert!((x - 60.0).hypot(y - 160.0) < 2.0, "{x} {y}");
///
/// let empty = Photograph::from_light(240, 200, vec![0.1; 240 * 200])?;
/// assert_eq!(find_fold(&empty, &LensEstimate::UNKNOWN), Err(NoFold::Nothing));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn find_fold(photograph: &Photograph, lens: &LensEstimate) -> Result<DetectedFold, NoFold> {
    most_probable(photograph, &Reduced::of(photograph), lens, LEAST_CONFIDENCE, |_| true)
}

/// The fold and the colour chart of a photograph, in less time than one after the other.
///
/// # Returns
/// As [`find_fold`] and [`find_chart`].
///
/// # Example
/// ```
/// use vfold::image::{LensEstimate, NoFold, Photograph, find_fold_and_chart};
/// let empty = Photograph::from_light(240, 200, vec![0.1; 240 * 200])?;
/// assert_eq!(find_fold_and_chart(&empty, &LensEstimate::UNKNOWN), (Err(NoFold::Nothing), None));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn find_fold_and_chart(
    photograph: &Photograph,
    lens: &LensEstimate,
) -> (Result<DetectedFold, NoFold>, Option<DetectedChart>) {
    both(photograph, &Reduced::of(photograph), lens)
}

fn both(
    photograph: &Photograph,
    reduced: &Reduced,
    lens: &LensEstimate,
) -> (Result<DetectedFold, NoFold>, Option<DetectedChart>) {
    rayon::join(
        || most_probable(photograph, reduced, lens, LEAST_CONFIDENCE, |_| true),
        || chart::most_alike(photograph, reduced, &lens.lens).map(|(chart, _)| chart),
    )
}

/// What a person is shown of a photograph.
#[derive(Debug, Clone, PartialEq)]
pub struct Detections {
    /// As [`find_fold`] returns it.
    pub fold: Result<DetectedFold, NoFold>,
    /// As [`find_chart`] returns it, if it is [sure](DetectedChart::is_sure).
    pub chart: Option<DetectedChart>,
    /// Corners of even bright areas elsewhere that may be white paper or a card, px of the upright picture,
    /// the whitest first: none is known to be white.
    pub white_candidates: Vec<[Point; 4]>,
}

/// Fold, colour chart and areas that may be white, for a person to decide.
///
/// # Example
/// ```
/// use vfold::image::{LensEstimate, NoFold, Photograph, find_all};
/// let card = |x: usize, y: usize| (60..120).contains(&x) && (40..100).contains(&y);
/// let light = (0..240 * 200).map(|k| if card(k % 240, k / 240) { 0.8 } else { 0.1 }).collect();
/// let found = find_all(&Photograph::from_light(240, 200, light)?, &LensEstimate::UNKNOWN);
/// assert!(found.fold == Err(NoFold::Nothing) && found.chart.is_none());
/// assert!(found.white_candidates[0].iter().all(|corner| card(corner.x as usize, corner.y as usize)));
/// # Ok::<(), vfold::Error>(())
/// ```
#[must_use]
pub fn find_all(photograph: &Photograph, lens: &LensEstimate) -> Detections {
    let reduced = Reduced::of(photograph);
    let (fold, chart) = both(photograph, &reduced, lens);
    let chart = chart.filter(DetectedChart::is_sure);
    let panels = fold.as_ref().ok().map(|found| &found.panels);
    let white_candidates =
        white_areas(photograph, &reduced, (panels, chart.as_ref().map(|chart| &chart.corners)));
    Detections { fold, chart, white_candidates }
}

/// The fold with two stated places, px, on its two panels, in either order; returned at any confidence,
/// because a person reviews it.
///
/// # Errors
/// As [`find_fold`].
///
/// # Example
/// ```
/// use vfold::image::{LensEstimate, NoFold, Photograph, Point, find_fold_around};
/// let empty = Photograph::from_light(240, 200, vec![0.1; 240 * 200])?;
/// let clicks = [Point::new(60.0, 40.0), Point::new(120.0, 90.0)];
/// assert_eq!(find_fold_around(&empty, &LensEstimate::UNKNOWN, clicks), Err(NoFold::Nothing));
/// # Ok::<(), vfold::Error>(())
/// ```
pub fn find_fold_around(
    photograph: &Photograph,
    lens: &LensEstimate,
    panels: [Point; 2],
) -> Result<DetectedFold, NoFold> {
    let reduced = Reduced::of(photograph);
    most_probable(photograph, &reduced, lens, 0.0, |outline| outline.has_panels_at(panels))
}

/// The most probable fold that `may_be` accepts.
fn most_probable(
    photograph: &Photograph,
    reduced: &Reduced,
    lens: &LensEstimate,
    least_confidence: f64,
    may_be: impl Fn(&Outline) -> bool,
) -> Result<DetectedFold, NoFold> {
    let (_, candidates) = candidates(reduced, |outline| may_be(&outline.scaled(reduced.scale as f64)));
    let trusted = candidates.iter().map(|candidate| (confidence(&candidate.clues), candidate));
    let best = trusted.max_by(|a, b| a.0.total_cmp(&b.0)).ok_or(NoFold::Nothing)?;
    let (confidence, Candidate { outline, blur, .. }) = best;
    let nearest = nearest_to_frame(outline, reduced);
    if nearest < -BEYOND_PX || (confidence < DetectedFold::SURE && nearest < AT_EDGE_PX) {
        return Err(NoFold::Cut);
    }
    if confidence < least_confidence {
        return Err(NoFold::Nothing);
    }
    let scale = reduced.scale as f64;
    let outline = outline.scaled(scale).named();
    let reach_px = LEAST_REACH_PX.max(REACH_PX * scale + REACH_PX);
    let blur = blur.filter(|_| reduced.scale == 1); // known of the picture itself
    let within = (lens, reach_px);
    let refined = refine_in_sight(photograph, &outline.marked(), within, blur, MOST_OF_PIECE).ok();
    let exact =
        refined.map(|refined| (Outline::of_panels([refined.panels[0], refined.panels[1]]), refined.lens));
    let (exact, lens) = exact.filter(|(exact, _)| exact.may_be_fold()).unwrap_or((outline, *lens));
    Ok(DetectedFold { panels: exact.points(), lens, confidence })
}

/// The least distance of a corner from the edge of the reduced picture, px, negative beyond it.
fn nearest_to_frame(outline: &Outline, reduced: &Reduced) -> f64 {
    let [width, height] = [reduced.width, reduced.height].map(|side| side as f64);
    let inside = |p: &Place| p.x.min(width - p.x).min(p.y).min(height - p.y);
    outline.0.iter().map(inside).fold(f64::INFINITY, f64::min)
}

/// A fold considered by the search, with its features.
#[derive(Debug, Clone, PartialEq)]
pub struct WeighedFold {
    /// Corners of both panels, px, as [`DetectedFold::panels`].
    pub panels: [[Point; 4]; 2],
    /// Its features.
    pub weighed: Vec<f64>,
}

/// All folds considered in a photograph, for fitting the weights: hypotheses as found, and the most probable
/// ones refined.
#[must_use]
pub fn weighed_folds(photograph: &Photograph) -> [Vec<WeighedFold>; 2] {
    let reduced = Reduced::of(photograph);
    let (hypotheses, candidates) = candidates(&reduced, |_| true);
    let fold = |outline: &Outline, weighed: &[f64]| WeighedFold {
        panels: outline.scaled(reduced.scale as f64).named().points(),
        weighed: weighed.to_vec(),
    };
    [
        hypotheses.iter().map(|hypothesis| fold(&hypothesis.outline, &hypothesis.features)).collect(),
        candidates.iter().map(|candidate| fold(&candidate.outline, &candidate.clues)).collect(),
    ]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::synthetic::{HEIGHT, WIDTH, outline, picture};
    use super::*;

    fn found(fold: &Outline, scale: usize) -> DetectedFold {
        find_fold(&picture(fold, scale), &LensEstimate::UNKNOWN).unwrap()
    }

    #[test]
    fn a_fold_is_found_surely_in_pictures_of_any_size() {
        for scale in [1, 4] {
            let found = found(&outline(), scale);
            let off = Outline::of_panels(found.panels).distance_px(&outline().scaled(scale as f64));
            assert!(off < 0.5 * scale as f64 && found.is_sure(), "{scale}: {off} {found:?}");
        }
    }

    #[test]
    fn a_fold_is_found_around_places_on_its_panels_alone() {
        let photograph = picture(&outline(), 2);
        let [a, b] = outline().scaled(2.0).points().map(|panel| {
            let mean = |of: fn(&Point) -> f64| panel.iter().map(of).sum::<f64>() / 4.0;
            Point::new(mean(|p| p.x), mean(|p| p.y))
        });
        let around = |panels| find_fold_around(&photograph, &LensEstimate::UNKNOWN, panels);
        assert_eq!(around([b, a]).unwrap().panels, found(&outline(), 2).panels);
        assert!(around([a, a]).is_err());
    }

    #[test]
    fn a_turned_fold_is_named_by_how_it_lies() {
        let (x, y) = (WIDTH as f64 / 2.0, HEIGHT as f64 / 2.0);
        let turned = Outline(outline().0.map(|p| Place::new(x + p.y - y, y - p.x + x)));
        let fold = found(&turned, 1);
        let [a, b] = fold.panels;
        assert!(fold.is_sure() && a[0] == b[0] && a[0].x > a[1].x && a[2].y > b[2].y, "{fold:?}");
    }

    #[test]
    fn a_fold_cut_by_the_edge_is_not_claimed() {
        let cut = Outline(outline().0.map(|p| p - Place::new(72.0, 0.0)));
        let found = find_fold(&picture(&cut, 1), &LensEstimate::UNKNOWN);
        assert!(!found.is_ok_and(|found| found.is_sure()), "{found:?}");
    }

    /// Light falls towards one side of a sheet without a crease.
    #[test]
    fn a_flat_sheet_is_not_claimed() {
        let inside = |x: usize, y: usize| (60..260).contains(&x) && (50..210).contains(&y);
        let light = |x: usize, y: usize| if inside(x, y) { 0.5 + 0.001 * x as f32 } else { 0.1 };
        let light = (0..WIDTH * HEIGHT).map(|k| light(k % WIDTH, k / WIDTH)).collect();
        let sheet = Photograph::from_light(WIDTH, HEIGHT, light).unwrap();
        assert!(!find_fold(&sheet, &LensEstimate::UNKNOWN).is_ok_and(|found| found.is_sure()));
    }
}
