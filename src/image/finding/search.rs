//! Folds that a picture may show, most probable first.

use rayon::prelude::*;

use super::evidence::{Evidence, curvatures, steps};
use super::features::{FEATURES, features};
use super::light::LogLight;
use super::outline::{Outline, distinct};
use super::pairs::{halves, pairs, slid, straightened};
use super::plane::Plane;
use super::quads::quads;
use super::reduced::Reduced;
use super::score::log_odds;
use super::segments::{FINE_PX, RIDGE_PX, segments};
use super::snap::snapped;

/// Blur for the coarse curvature of light across a crease, px.
const COARSE_RIDGE_PX: f32 = 4.0;
/// Quadrilaterals that may be panels, those that may be whole folds, and pairs.
const QUADS: usize = 400;
const HALVED: usize = 40;
const PAIRS: usize = 150;
/// Pairs differ if a corner is off by more than this, px.
const PAIRS_APART_PX: f64 = 3.0;
/// Number of the most probable folds whose creases are straightened, and slid.
const STRAIGHTENED: usize = 40;
const SLID: usize = 60;
/// Search distance when sides are moved to an edge, px, and after sliding a crease.
const SNAP_PX: f64 = 5.0;
const SLID_SNAP_PX: f64 = 4.0;
/// Creases slid by less than this, px, count as unchanged.
const SLID_PX: f64 = 3.0;
/// Hypotheses that are kept, and the least distance between them, px.
const KEPT: usize = 40;
const APART_PX: f64 = 2.5;

/// The evidence of a reduced picture for edges, and its light.
pub(super) struct Views {
    pub evidence: Evidence,
    pub light: LogLight,
}

/// A fold that a picture may show.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hypothesis {
    pub outline: Outline,
    pub features: [f64; FEATURES],
    /// Against no fold.
    pub log_odds: f64,
}

/// The most probable folds of a reduced picture, in its pixels.
pub(super) fn search(reduced: &Reduced) -> (Views, Vec<Hypothesis>) {
    let channels = reduced.even();
    let sum = Plane::sum(&channels);
    let (fine, (ridges, (coarse, light))) = rayon::join(
        || steps(&channels, FINE_PX),
        || {
            rayon::join(
                || curvatures(&sum, RIDGE_PX),
                || rayon::join(|| curvatures(&sum, COARSE_RIDGE_PX), || LogLight::of(reduced)),
            )
        },
    );
    let views = Views { evidence: Evidence::new(&fine, &ridges, &coarse), light };
    let segments = segments(&channels, &fine, &ridges);
    let quads = quads(&segments, &views.evidence, &views.light, QUADS);
    let pairs = distinct(pairs(&quads), PAIRS_APART_PX, PAIRS).into_iter().map(|(_, pair)| pair);
    let halved = &quads[..HALVED.min(quads.len())];
    let folds: Vec<Outline> = pairs.chain(halves(halved, &views.light)).collect();
    let hypotheses = views.hypotheses(&views.variants(&folds));
    (views, hypotheses)
}

impl Views {
    /// Folds with their sides along edges, and variants with other creases.
    fn variants(&self, folds: &[Outline]) -> Vec<Outline> {
        let snap = |fold: &Outline| snapped(fold, &self.evidence, SNAP_PX);
        let mut all: Vec<Outline> = folds.par_iter().map(snap).collect();
        let straight: Vec<Outline> = all.iter().take(STRAIGHTENED).flat_map(straightened).collect();
        let straight: Vec<Outline> = straight.par_iter().map(snap).collect();
        let slide = |fold: &Outline| {
            let moved = slid(fold, &self.evidence);
            let is_other = (0..2).any(|end| (moved.0[end] - fold.0[end]).amax() > SLID_PX);
            is_other.then(|| snapped(&moved, &self.evidence, SLID_SNAP_PX))
        };
        let most_probable: Vec<Outline> = all.iter().take(SLID).chain(&straight).copied().collect();
        let slid: Vec<Outline> = most_probable.par_iter().filter_map(slide).collect();
        all.extend(straight);
        all.extend(slid);
        all
    }

    fn hypotheses(&self, folds: &[Outline]) -> Vec<Hypothesis> {
        let scored = folds.par_iter().filter(|fold| fold.may_be_fold()).map(|fold| self.judge(fold));
        let scored: Vec<Hypothesis> = scored.collect();
        let ranked = scored.iter().map(|hypothesis| (hypothesis.log_odds, hypothesis.outline)).collect();
        let kept = distinct(ranked, APART_PX, KEPT);
        let of = |outline: &Outline| scored.iter().find(|hypothesis| hypothesis.outline == *outline).copied();
        kept.iter().filter_map(|(_, outline)| of(outline)).collect()
    }

    /// A fold with its features and log odds.
    pub fn judge(&self, outline: &Outline) -> Hypothesis {
        let features = features(outline, &self.evidence, &self.light);
        Hypothesis { outline: *outline, features, log_odds: log_odds(&features) }
    }
}
