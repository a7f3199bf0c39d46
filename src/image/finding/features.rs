//! Features for and against a fold.

use super::evidence::{Evidence, Support};
use super::light::{LogLight, PanelLight};
use super::outline::{Outline, Quad};

/// Number of features that distinguish folds from anything else.
pub(super) const FEATURES: usize = 30;
/// Least strength of a step inside a panel.
const INNER_STEP: f64 = 0.03;

/// Properties of a fold as seen.
struct Seen {
    sides: [Support; 7],
    light: [PanelLight; 2],
    /// Fraction of a panel's inside with edges on it, the larger of the two.
    inner_edges: f64,
    /// Departure of the panels from parallelograms, the larger of the two.
    skew: f64,
    size_px: f64,
    /// Absolute logarithm of the ratio of the panels' depths.
    depths: f64,
}

/// The [`FEATURES`] for and against a fold; logarithms expand the ends of scales.
pub(super) fn features(fold: &Outline, evidence: &Evidence, light: &LogLight) -> [f64; FEATURES] {
    Seen::of(fold, evidence, light).features()
}

impl Seen {
    fn of(fold: &Outline, evidence: &Evidence, light: &LogLight) -> Self {
        let side = |side: usize| evidence.support(fold.side(side), 24, &[-2.0, -1.0, 0.0, 1.0, 2.0]);
        let panels = fold.panels();
        let depths = panels.map(|panel| ((panel[2] + panel[3] - panel[0] - panel[1]) / 2.0).norm().max(1.0));
        Self {
            sides: [0, 1, 2, 3, 4, 5, 6].map(side),
            light: panels.each_ref().map(|panel| light.panel(panel)),
            inner_edges: greater(panels.each_ref().map(|panel| evidence.inner_edges(panel, INNER_STEP))),
            skew: greater(panels.each_ref().map(skew)),
            size_px: fold.size_px(),
            depths: (depths[0] / depths[1]).ln().abs(),
        }
    }

    fn features(&self) -> [f64; FEATURES] {
        let outer = &self.sides[1..];
        let steps = outer.iter().map(|side| side.step);
        let mean = steps.clone().sum::<f64>() / outer.len() as f64;
        let least = steps.fold(1.0, f64::min);
        let weakest = outer.iter().map(|side| side.weakest).fold(1.0, f64::min);
        let outer_sides = self.sides[2].step.min(self.sides[5].step);
        let crease = self.sides[0].step.max(self.sides[0].ridge);
        let near_one = |part: f64| (1.0 - part + 0.02).ln();
        let [a, b] = &self.light;
        let rise = a.rise.min(b.rise).clamp(-0.5, 0.5);
        let rises = (a.rise + b.rise).clamp(-1.0, 1.0);
        let unevenness = a.unevenness.max(b.unevenness);
        let colour = (a.colour[0] - b.colour[0]).hypot(a.colour[1] - b.colour[1]).min(1.0);
        let skew = self.skew.min(1.0);
        let size = (self.size_px / 100.0).ln();
        let level = (a.level - b.level).abs().min(2.0);
        let colour_change = a.colour_change.min(b.colour_change).min(0.5);
        [
            mean,
            least,
            weakest,
            outer_sides,
            crease,
            near_one(mean),
            near_one(least),
            near_one(weakest),
            near_one(crease),
            rise.clamp(-0.2, 0.15),
            rises.clamp(-0.3, 0.6),
            rise.min(0.0),
            (unevenness + 0.005).ln(),
            unevenness.min(0.15),
            colour.min(0.3),
            (colour + 0.01).ln(),
            self.inner_edges,
            (self.inner_edges - 0.1).max(0.0),
            skew,
            (skew - 0.2).max(0.0),
            size.clamp(-2.0, 1.5),
            size.clamp(-2.0, 1.5).powi(2),
            f64::from(a.seen.min(b.seen) < 0.98),
            a.wrong_way.max(b.wrong_way),
            level.min(0.5),
            level,
            self.depths,
            colour_change,
            (colour_change + 0.01).ln(),
            (a.at_crease - b.at_crease).abs().min(0.5),
        ]
    }
}

fn greater([a, b]: [f64; 2]) -> f64 {
    a.max(b)
}

/// Departure of a quadrilateral from a parallelogram, relative to its first side.
fn skew(quad: &Quad) -> f64 {
    (quad[1] - quad[0] - quad[2] + quad[3]).norm() / (quad[1] - quad[0]).norm()
}
