//! Tests whether a photograph contradicts the stated camera: under one sheet model, on the inferred kind of
//! day, each measured camera is weighed against it.
//!
//! Another camera belongs to another spectrum, and the probability of that spectrum tells, as for lights
//! ([`light`](super::light)). Errors of the sensitivities are unknowns, so that a camera with nearly the same
//! curves is no rival.

use std::sync::OnceLock;

use super::family::Family;
use super::photograph::hypotheses::Hypothesis;
use super::photograph::{Parts, Weighed};
use super::prior::Prior;
use super::rival::{LN_AHEAD, Rival, ln_enough};
use super::search::Search;
use crate::camera::known_sensitivities;
use crate::solve::forecast::ScoreTest;
use crate::solve::posterior::Model;
use crate::spectrum::WavelengthGrid;

/// Log evidence ratio that outweighs a statement, fifty to one. Fitted to `../shared/train`: none of its 48
/// correctly stated cameras is doubted; with a ratio of 3, one would be.
const LN_ODDS: f64 = 4.0;
/// Number of cameras searched, those that a linear model predicts to be the most probable, and the least
/// logarithm of how many times as probable they must be by that forecast: half of the odds. With two, fewer
/// wrong cameras were noticed in `benches/mistakes.sh`.
const SEARCHED: usize = 4;
const LN_HOPEFUL: f64 = 2.0;
/// Orders of three channels other than their own.
const ORDERS: [([usize; 3], &str); 5] =
    [([2, 1, 0], "BGR"), ([0, 2, 1], "RBG"), ([1, 0, 2], "GRB"), ([1, 2, 0], "GBR"), ([2, 0, 1], "BRG")];

/// A camera that may have taken a photograph: its sensitivities, one number per waveband for each channel.
#[derive(Clone, Debug)]
struct OtherCamera {
    name: String,
    sensitivities: Vec<Vec<f64>>,
}

/// Cameras that may have taken a photograph instead of the stated one, loaded on first use.
#[derive(Clone, Debug)]
pub struct OtherCameras {
    grid: WavelengthGrid,
    stated: [Vec<f64>; 3],
    cameras: OnceLock<Vec<OtherCamera>>,
}

impl OtherCameras {
    /// Alternatives to a camera with these sensitivities, one number per waveband for each channel; `None` if
    /// it has not three channels.
    #[must_use]
    pub fn than(grid: &WavelengthGrid, stated: &[Vec<f64>]) -> Option<Self> {
        let stated = stated.to_vec().try_into().ok()?;
        Some(Self { grid: grid.clone(), stated, cameras: OnceLock::new() })
    }

    /// The stated camera with its channels in another order, and all measured cameras.
    fn cameras(&self) -> &[OtherCamera] {
        self.cameras.get_or_init(|| {
            let reordered = ORDERS.iter().map(|(order, letters)| OtherCamera {
                name: format!("a camera with its channels in the order {letters}"),
                sensitivities: order.map(|channel| self.stated[channel].clone()).to_vec(),
            });
            let measured = known_sensitivities(&self.grid).unwrap_or_default().into_iter();
            let measured = measured.map(|known| OtherCamera {
                name: known.camera.name(),
                sensitivities: known.sensitivities.to_vec(),
            });
            reordered.chain(measured).collect()
        })
    }
}

/// The camera among `others`, if any, with which a photograph is much more probable than with the stated one,
/// given its hypotheses as weighed.
pub fn rival_camera(parts: &Parts, weighed: &Weighed, others: &OtherCameras, prior: &Prior) -> Option<Rival> {
    let Weighed { photographs, of_family, ln_by_emission, .. } = weighed;
    let (day, mode) = of_family.as_ref()?;
    let hypothesis = Hypothesis::of_family(*day);
    let mut search = Search::new(photographs, prior);
    // the mode of a sheet that may emit light has more numbers
    let start = Some(mode.clone()).filter(|w| Some(w.len()) == photographs.unknowns(hypothesis, prior));
    let stated = search.sort((hypothesis, 0.0), start, f64::NEG_INFINITY)?;
    let (test, residuals) =
        (ScoreTest::at(&stated.solution, search.tempering())?, &stated.solution.at.residuals);
    let of_stated = photographs.model(hypothesis, prior.broad())?;
    let (first, w) = (of_stated.first(), &stated.solution.w);
    let here = first.model.evaluate(&first.own(w)).ingredients;
    let hopeful = others.cameras().iter().filter_map(|camera| {
        let taken = parts.taken_exactly_by(&camera.sensitivities);
        let ln_gain = test.ln_gain_by(1.0, &(residuals - first.model.residuals_by(&taken, &here)));
        (ln_gain > LN_HOPEFUL + ln_by_emission).then_some((ln_gain, camera))
    });
    let mut hopeful: Vec<_> = hopeful.collect();
    hopeful.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let least = stated.ln_weight() + ln_by_emission + LN_AHEAD;
    let by_classes = hopeful.into_iter().take(SEARCHED).filter_map(|(_, camera)| {
        let parts = parts.taken_by(&camera.sensitivities);
        let family = photographs.in_light_of(&parts);
        let start = family.model(hypothesis, prior.broad())?.carried(&of_stated, w);
        let mut search = Search::new(&family, prior);
        let tried = search.sort((hypothesis, 0.0), Some(start), least)?;
        (tried.ln_weight() > least).then_some(())?;
        Some((camera.name.clone(), search.ln_evidence_by_classes(&tried)?))
    });
    let by_classes: Vec<_> = by_classes.collect();
    (!by_classes.is_empty()).then_some(())?;
    let ln_stated = search.ln_evidence_by_classes(&stated)? + ln_by_emission;
    Rival::of(by_classes.into_iter(), ln_stated, ln_enough(LN_ODDS, *ln_by_emission))
}
