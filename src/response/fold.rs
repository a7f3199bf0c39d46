//! Interreflections of light on a fold for all reflectances at once: eqs. (26) to (28), exploiting the fold's
//! symmetry.
//!
//! As panels see each other but not themselves, K = [0 F; Fᵀ 0], and the modes of uniform light on one panel
//! give everything: panels of two reflectances, a tilted sun, and the sky, whose light on a panel is
//! `1 − F·1`.

use nalgebra::DMatrix;

use super::lanczos::{Excited, Lanczos};
use super::{ModeSet, PanelOperator};
use crate::error::{Error, Result};

/// Poles nearer to zero than this are not merged with their twin of opposite sign: rounding mixes the modes
/// of close poles, and only the sum of the two is accurate.
const NEAR_TWIN: f64 = 1e-3;

/// Interreflections of uniform light on either panel, as poles and residues of every facet.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    modes: Modes,
    /// Facets of one panel.
    facets: usize,
}

/// Modes excited by uniform light.
///
/// Unit irradiance on one panel, both panels having reflectance r, becomes `Σ_k residue_k / (1 − r²·pole_k²)`
/// on that panel, and the same with `r·pole_k·residue_k` on the other.
#[derive(Clone, Debug, PartialEq)]
pub enum Modes {
    /// For a symmetric fold: on either panel, whichever panel is lit.
    Shared(ModeSet),
    /// Light on panel 0 and light on panel 1: each set holds the facets of panel 0, then those of panel 1.
    Separate([ModeSet; 2]),
}

/// Excitation of a mode on a panel by a light: a facet there receives
/// `residue·(own + r_other·pole·other) / (1 − r_own·r_other·pole²)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excitation {
    /// Pole of the mode.
    pub pole: f64,
    /// From light on the facet's own panel.
    pub own: f64,
    /// From light on the other panel.
    pub other: f64,
}

impl Response {
    /// Reduces `operator` to poles and residues whose residual in eq. (15) is at most `tolerance`, relative
    /// to the light, for every reflectance in [0, 1].
    ///
    /// # Returns
    /// The response and the residual reached.
    ///
    /// # Source
    /// Deeb et al., eqs. (16) and (26) to (28); Lanczos' method with partial reorthogonalisation
    /// (Simon, *Mathematics of Computation* 42, 1984, p. 115). It stops by the residual at r = 1, which
    /// converges slowest.
    ///
    /// # Errors
    /// [`Error::Numeric`] if light does not leave the fold: the operator passes on all it receives.
    pub fn solve<O: PanelOperator>(operator: &O, tolerance: f64) -> Result<(Self, f64)> {
        if operator.is_symmetric() {
            let start = operator.uniform(0);
            let one = Excited {
                direct: O::AFTER_A_BOUNCE.then(|| vec![1.0; operator.facet_means(0, &start).len()]),
                start,
                apply: |x: &[f64], out: &mut [f64]| operator.apply(0, x, out),
                means: |x: &[f64]| operator.facet_means(0, x),
            };
            let (set, residual) = one.lanczos(tolerance)?;
            let facets = set.residues.nrows();
            return Ok((Self { modes: Modes::Shared(set), facets }, residual));
        }
        let [(set0, residual0), (set1, residual1)] = both_panels(operator, tolerance)?;
        let facets = set0.residues.nrows() / 2;
        Ok((Self { modes: Modes::Separate([set0, set1]), facets }, residual0.max(residual1)))
    }

    /// The response of a flat sheet with this number of `facets` per panel, which exchange no light.
    #[must_use]
    pub fn without_bounces(facets: usize) -> Self {
        let set = ModeSet { poles: vec![0.0], residues: DMatrix::repeat(facets, 1, 1.0) };
        Self { modes: Modes::Shared(set), facets }
    }

    /// A response from its modes.
    ///
    /// # Errors
    /// [`Error::Field`] if the shapes disagree, a pole is not inside (−1, 1), or the residues do not belong
    /// to uniform light.
    pub fn new(modes: Modes) -> Result<Self> {
        let (sets, panels): (&[ModeSet], _) = match &modes {
            Modes::Shared(set) => (std::slice::from_ref(set), 1),
            Modes::Separate(sets) => (sets, 2),
        };
        let facets = sets[0].residues.nrows() / panels;
        for (source, set) in sets.iter().enumerate() {
            set.check()?;
            if set.residues.nrows() != facets * panels {
                return Err(Error::field(
                    "response.residues",
                    "needs equal numbers of facets on both panels",
                ));
            }
            // Before any bounce, uniform light is uniform.
            let lit = set.residues.rows(source * facets, facets);
            if !lit.column_sum().iter().all(|sum| (sum - 1.0).abs() < 1e-3) {
                return Err(Error::field(
                    "response.residues",
                    "those of a facet do not add up to 1; make the scene again with vkernel",
                ));
            }
        }
        Ok(Self { modes, facets })
    }

    /// The underlying modes.
    #[must_use]
    pub fn modes(&self) -> &Modes {
        &self.modes
    }

    /// All poles, in the order of [`Response::excitations`].
    #[must_use]
    pub fn poles(&self) -> Vec<f64> {
        match &self.modes {
            Modes::Shared(set) => set.poles.clone(),
            Modes::Separate([set0, set1]) => [set0.poles.as_slice(), &set1.poles].concat(),
        }
    }

    /// Number of facets on one panel.
    #[must_use]
    pub fn facets(&self) -> usize {
        self.facets
    }

    /// Excitations by `light` of each mode on `panel`, in the order of [`Response::poles`].
    #[must_use]
    pub fn excitations(&self, panel: usize, light: ModeLight) -> Vec<Excitation> {
        match &self.modes {
            Modes::Shared(set) => {
                let excite = |pole: &f64| {
                    let (own, other) = light.on_both(panel, *pole);
                    Excitation { pole: *pole, own, other }
                };
                set.poles.iter().map(excite).collect()
            }
            Modes::Separate(sets) => {
                let of_source = |source: usize| {
                    sets[source].poles.iter().map(move |pole| {
                        let (lit, facing) = light.on_one(source, *pole);
                        let (own, other) = if source == panel { (lit, facing) } else { (facing, lit) };
                        Excitation { pole: *pole, own, other }
                    })
                };
                of_source(0).chain(of_source(1)).collect()
            }
        }
    }

    /// Residues of the modes on `panel`: facet by pole, in the order of [`Response::poles`].
    #[must_use]
    pub fn residues(&self, panel: usize) -> DMatrix<f64> {
        match &self.modes {
            Modes::Shared(set) => set.residues.clone(),
            Modes::Separate(sets) => {
                let [of_0, of_1] =
                    sets.each_ref().map(|set| set.residues.rows(panel * self.facets, self.facets));
                DMatrix::from_columns(&of_0.column_iter().chain(of_1.column_iter()).collect::<Vec<_>>())
            }
        }
    }

    /// Irradiance of a facet of `panel` in `light`, all bounces included, for these `reflectances` of the
    /// panels.
    #[must_use]
    pub fn irradiance(&self, panel: usize, facet: usize, light: ModeLight, reflectances: [f64; 2]) -> f64 {
        let (both, r_other) = (reflectances[0] * reflectances[1], reflectances[1 - panel]);
        let received = |(mode, (_, residue)): (Excitation, (f64, f64))| {
            residue * (mode.own + r_other * mode.pole * mode.other) / (1.0 - both * mode.pole * mode.pole)
        };
        let (sets, row) = match &self.modes {
            Modes::Shared(set) => (std::slice::from_ref(set), facet),
            Modes::Separate(sets) => (sets.as_slice(), panel * self.facets + facet),
        };
        let residues = sets.iter().flat_map(|set| set.of_facet(row));
        self.excitations(panel, light).into_iter().zip(residues).map(received).sum()
    }
}

/// A light on the panels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModeLight {
    /// Parallel light: irradiance on panel 0 and on panel 1.
    Sun([f64; 2]),
    /// A uniform sky with this irradiance on an unobstructed plane: each panel receives `1 − F·1` of it, what
    /// the other does not hide.
    Sky(f64),
}

impl ModeLight {
    /// True if identical panels receive different light.
    #[must_use]
    pub fn is_uneven(self) -> bool {
        matches!(self, Self::Sun([on_0, on_1]) if on_0.total_cmp(&on_1).is_ne())
    }

    /// Excitations of a mode shared by both panels: by the light on `panel`, and by that on the other.
    fn on_both(self, panel: usize, pole: f64) -> (f64, f64) {
        match self {
            Self::Sun(sun) => (sun[panel], sun[1 - panel]),
            Self::Sky(sky) => (sky * (1.0 - pole), sky * (1.0 - pole)),
        }
    }

    /// Excitations of a mode of panel `source`: by the light there, and by that on the other panel.
    fn on_one(self, source: usize, pole: f64) -> (f64, f64) {
        match self {
            Self::Sun(sun) => (sun[source], 0.0),
            Self::Sky(sky) => (sky, -sky * pole),
        }
    }
}

/// Modes of uniform light on either panel, with residues on both, and the residuals.
///
/// Light that starts on one panel is on the other after every odd number of bounces. Light from the two
/// panels is therefore never on the same panel, and one product serves both.
fn both_panels<O: PanelOperator>(operator: &O, tolerance: f64) -> Result<[(ModeSet, f64); 2]> {
    let uniform = [0, 1].map(|panel| operator.uniform(panel));
    let middle = uniform[0].len();
    let on = |panel: usize, x: &[f64]| {
        let mut light = vec![0.0; middle + uniform[1].len()];
        halves(&mut light, middle)[panel].copy_from_slice(x);
        light
    };
    let mut runs = [0, 1].map(|source| Lanczos::new(&on(source, &uniform[source]), tolerance));
    let mut residuals = [None; 2];
    for bounce in 0.. {
        let is_running = residuals.map(|residual: Option<f64>| residual.is_none());
        // Panels on which the light of a source is, and to which it goes.
        let panels = [0, 1].map(|source| [(source + bounce) % 2, (source + bounce + 1) % 2]);
        let light = runs.each_ref().map(|run| run.last().split_at(middle)).map(|(on_0, on_1)| [on_0, on_1]);
        let mut product = uniform.each_ref().map(|of| vec![0.0; of.len()]);
        let [on_0, on_1] = &mut product;
        match is_running {
            [false, false] => break,
            [true, true] => {
                let first = panels[0][0];
                operator.apply_both([light[first][0], light[1 - first][1]], [on_0, on_1]);
            }
            [of_0, _] => {
                let source = usize::from(!of_0);
                let [from, to] = panels[source];
                operator.apply(to, light[source][from], &mut product[to]);
            }
        }
        let [run_0, run_1] = &mut runs;
        let take = |source: usize, run: &mut Lanczos| match residuals[source] {
            None => run.take(on(panels[source][1], &product[panels[source][1]])),
            done => Ok(done),
        };
        let (of_0, of_1) = rayon::join(|| take(0, run_0), || take(1, run_1));
        residuals = [of_0?, of_1?];
    }
    let facets = operator.facet_means(0, &uniform[if O::AFTER_A_BOUNCE { 1 } else { 0 }]).len();
    let means = |x: &[f64]| {
        let (x0, x1) = x.split_at(middle);
        let seen = if O::AFTER_A_BOUNCE { [x1, x0] } else { [x0, x1] };
        let of = |panel: usize| match seen[panel].iter().all(|x| *x == 0.0) {
            true => vec![0.0; facets],
            false => operator.facet_means(panel, seen[panel]),
        };
        [of(0), of(1)].concat()
    };
    let modes = |source: usize| {
        let direct: Vec<f64> =
            (0..2 * facets).map(|facet| if facet / facets == source { 1.0 } else { 0.0 }).collect();
        let set = runs[source].modes(means, O::AFTER_A_BOUNCE.then_some(&direct));
        (fold_pairs(&set), residuals[source].unwrap_or(f64::INFINITY))
    };
    let (of_0, of_1) = rayon::join(|| modes(0), || modes(1));
    Ok([of_0, of_1])
}

/// The parts of a vector on either panel.
fn halves(x: &mut [f64], middle: usize) -> [&mut [f64]; 2] {
    let (on_0, on_1) = x.split_at_mut(middle);
    [on_0, on_1]
}

/// Panels that see only each other have pairs of poles ±g; one of each pair suffices unless they nearly
/// coincide.
fn fold_pairs(set: &ModeSet) -> ModeSet {
    let weight = |pole: f64| match pole {
        pole if pole.abs() < NEAR_TWIN => 1.0,
        pole if pole > 0.0 => 2.0,
        _ => 0.0,
    };
    let kept: Vec<usize> = (0..set.poles.len()).filter(|k| weight(set.poles[*k]) > 0.0).collect();
    let poles: Vec<f64> = kept.iter().map(|k| set.poles[*k]).collect();
    let mut residues = set.residues.select_columns(&kept);
    for (mut of_mode, pole) in residues.column_iter_mut().zip(&poles) {
        of_mode *= weight(*pole);
    }
    ModeSet { poles, residues }
}
