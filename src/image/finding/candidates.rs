//! The most probable folds, their sides moved to the edges that best explain the pixels, and the clues to
//! whether all corners are right.

use rayon::prelude::*;

use super::outline::{Outline, Place};
use super::reduced::Reduced;
use super::search::{Hypothesis, Views, search};
use super::tree::CLUES;
use crate::image::edges::{Edge, MOST_OF_PIECE, Marked, Settled, settle};
use crate::image::photograph::Photograph;
use crate::image::placing::{Lens, LensEstimate, Point};

/// Hypotheses that are examined closely.
const TRIED: usize = 4;
/// Rounds of moving their sides, which need not be exact.
const ROUNDS: usize = 2;
/// Search distance for an edge, relative to the panels' size, and its limits, px.
const REACH: f64 = 0.06;
const REACH_PX: [f64; 2] = [3.0, 8.0];
/// Candidates nearer to each other than the first, relative to their size, are the same fold; further apart
/// than the second, rivals.
const SAME: f64 = 0.015;
const RIVAL: f64 = 0.05;
/// Log odds assigned to a missing rival.
const NO_RIVAL: f64 = -10.0;

/// A fold whose sides lie along edges.
pub(super) struct Candidate {
    /// In pixels of the reduced picture.
    pub outline: Outline,
    /// Number of the blur of the reduced picture's edges.
    pub blur: Option<usize>,
    /// Clues to whether all corners are right.
    pub clues: [f64; CLUES],
}

/// The folds that a reduced picture may show and `may_be` accepts, and the most probable of them refined.
pub(super) fn candidates(
    reduced: &Reduced,
    may_be: impl Fn(&Outline) -> bool,
) -> (Vec<Hypothesis>, Vec<Candidate>) {
    let (views, mut hypotheses) = search(reduced);
    hypotheses.retain(|hypothesis| may_be(&hypothesis.outline));
    let Ok(picture) = reduced.photograph() else { return (hypotheses, Vec::new()) };
    let refine =
        |hypothesis: &Hypothesis, blur: Option<usize>| Refined::of(hypothesis, &views, &picture, blur);
    let Some((first, others)) = hypotheses[..TRIED.min(hypotheses.len())].split_first() else {
        return (hypotheses, Vec::new());
    };
    // the most probable fold determines the picture's blur
    let first = refine(first, None);
    let blur = first.as_ref().and_then(|first| first.blur);
    let others: Vec<Refined> = others.par_iter().filter_map(|other| refine(other, blur)).collect();
    let refined: Vec<Refined> = first.into_iter().chain(others).collect();
    let candidate = |n: usize| {
        let Refined { now, blur, .. } = &refined[n];
        Candidate { outline: now.outline, blur: *blur, clues: clues(&refined, n) }
    };
    let candidates = (0..refined.len()).map(candidate).collect();
    (hypotheses, candidates)
}

/// A hypothesis before and after its sides were moved.
struct Refined {
    now: Hypothesis,
    edges: Vec<Option<Edge>>,
    first_edges: Vec<Option<Edge>>,
    /// Displacement of the corner that moved most, px.
    moved_px: f64,
    /// Number of its sides' blur.
    blur: Option<usize>,
}

impl Refined {
    fn of(hypothesis: &Hypothesis, views: &Views, picture: &Photograph, blur: Option<usize>) -> Option<Self> {
        let reach_px = (REACH * hypothesis.outline.size_px()).clamp(REACH_PX[0], REACH_PX[1]);
        let marked = hypothesis.outline.marked();
        let Settled { panels, first_edges, edges, blur, .. } = settle(
            picture,
            &marked,
            (&LensEstimate::stated(Lens::STRAIGHT), reach_px),
            (ROUNDS, blur),
            MOST_OF_PIECE,
        )
        .ok()?;
        let outline = Outline::of_panels([panels[0], panels[1]]);
        outline.may_be_fold().then(|| Self {
            now: views.judge(&outline),
            edges,
            first_edges,
            moved_px: outline.distance_px(&hypothesis.outline),
            blur,
        })
    }
}

/// Clues to whether all corners of the `n`th are right.
fn clues(all: &[Refined], n: usize) -> [f64; CLUES] {
    let this = &all[n];
    let size = this.now.outline.size_px();
    let far = |other: &&Refined| this.now.outline.distance_px(&other.now.outline) / size;
    let rivals = all.iter().filter(|other| far(other) > RIVAL).map(|other| other.now.log_odds);
    let alike = all.iter().filter(|other| far(other) < SAME).count() as f64;
    let gain = |edge: &Option<Edge>| edge.as_ref().map_or(0.0, |edge| edge.gain);
    let lead = |edge: &Option<Edge>| edge.as_ref().map_or(0.0, |edge| edge.lead);
    let least_two = |numbers: &mut dyn Iterator<Item = f64>| {
        numbers.fold([f64::INFINITY; 2], |[a, b], x| if x < a { [x, a] } else { [a, b.min(x)] })
    };
    let gains = least_two(&mut this.edges[1..].iter().map(gain));
    let leads = least_two(&mut this.first_edges[1..].iter().map(lead));
    let without = this.edges[1..].iter().filter(|edge| edge.is_none()).count() as f64;
    let least_sure = this.edges.iter().flatten().map(|edge| edge.sd_px).fold(0.0, f64::max);
    let of_gain = |gain: f64| (gain + 10.0).ln();
    let own = [
        this.now.log_odds,
        this.now.log_odds - rivals.fold(NO_RIVAL, f64::max),
        alike,
        of_gain(gains[0]),
        of_gain(gains[1]),
        of_gain(gain(&this.edges[0])),
        without,
        (least_sure / size + 1e-4).ln(),
        (this.moved_px / size + 1e-3).ln(),
        of_gain(leads[0]),
        of_gain(leads[1]),
        of_gain(lead(&this.first_edges[0])),
    ];
    let mut clues = [0.0; CLUES];
    clues[..own.len()].copy_from_slice(&own);
    clues[own.len()..].copy_from_slice(&this.now.features);
    clues
}

impl Outline {
    /// Its panels, in the form for refinement.
    pub fn marked(&self) -> [Marked; 2] {
        let [a, b] = self.points();
        [
            Marked { panel: 0, corners: a, joints: [0, 1, 2, 3] },
            Marked { panel: 1, corners: b, joints: [0, 1, 4, 5] },
        ]
    }

    /// The fold of two panels that share a crease.
    pub fn of_panels([a, b]: [[Point; 4]; 2]) -> Self {
        Self([a[0], a[1], a[2], a[3], b[2], b[3]].map(|p| Place::new(p.x, p.y)))
    }
}
