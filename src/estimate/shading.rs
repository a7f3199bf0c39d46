//! Checks that facets are shaded as in a fold: bounces make both panels brighter towards the crease, and the
//! same in colour.
//!
//! These checks need no model of a real sheet: where they fail, no spectrum can be measured, however well a
//! model fits. Their bounds leave a margin beyond the photographs on which hyperparameters are fitted
//! (`../shared/train`).

use std::ops::Range;

use nalgebra::DMatrix;

use super::verdict::{Doubt, Level};
use crate::forward::FacetValues;
use crate::geometry::FacetGrid;

/// Minimum number of rows and columns for shading to be visible.
const ROWS_LEAST: usize = 4;
/// Facets next to the crease that are darker than those at the outer sides by this (natural logarithm): a
/// lens darkens corners and a crease is rounded, but neither has as much effect.
const DARKER: f64 = 0.1;
/// Maximum difference (natural logarithm) between the ends of the crease in brightness, and in the ratio of
/// two channels: lens, ground and the position of the sun cause less.
const ENDS_APART: f64 = 0.18;
const END_COLOURS_APART: f64 = 0.14;
/// Maximum difference (natural logarithm) between the panels' outer halves in the ratios of channels, for
/// sheets of one colour: sky, ground and the other panel light both alike.
const COLOURS_APART: f64 = 0.2;
/// Maximum difference in brightness between the panels (natural logarithm) beyond the effect of the sun's
/// position.
const PANELS_APART: f64 = 0.45;
/// Standard deviations above which a difference is not due to chance.
const SURE: f64 = 3.0;

/// The facets of a photographed fold, and those expected.
pub struct Shading<'a> {
    grid: FacetGrid,
    rgb: &'a FacetValues,
    sd: &'a FacetValues,
    ideal: &'a DMatrix<f64>,
}

/// A logarithm of a ratio of means, with its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ratio {
    ln: f64,
    sd: f64,
}

impl<'a> Shading<'a> {
    /// Facets of two panels with this grid; `None` if there are too few rows.
    ///
    /// # Arguments
    /// - `rgb`: values; `sd`: standard deviations of their noise.
    /// - `ideal`: facets of an ideal fold in the stated scene with the estimated reflectance, facet by
    ///   channel, at any exposure.
    #[must_use]
    pub fn new(
        grid: FacetGrid,
        rgb: &'a FacetValues,
        sd: &'a FacetValues,
        ideal: &'a DMatrix<f64>,
    ) -> Option<Self> {
        (grid.rows >= ROWS_LEAST && rgb.len() == 2 * grid.len()).then_some(Self { grid, rgb, sd, ideal })
    }

    /// Signs that these are not facets of a fold with this spectrum, in the sun or else in the light of a
    /// sky, which is darker where panels meet.
    #[must_use]
    pub fn doubts(&self, is_sunlit: bool) -> Vec<Doubt> {
        let all = [
            self.darker_at_crease().filter(|_| is_sunlit),
            self.two_colours(),
            self.uneven_ends(),
            self.uneven_panels(),
        ];
        all.into_iter().flatten().collect()
    }

    /// Panels that differ more in brightness than the stated position of the sun explains.
    fn uneven_panels(&self) -> Option<Doubt> {
        let all: Vec<f64> = self.panels_apart().map(|apart| apart.ln).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        (mean.abs() > PANELS_APART).then(|| {
            Doubt::new(
                format!(
                    "relative to the other, panel {} is {:.1} times as bright as the stated sun would make \
                     it: a shadow, another light, or a sun far from the bisecting plane",
                    usize::from(mean < 0.0),
                    mean.abs().exp()
                ),
                "turn the fold until both panels are equally bright, or state --tilt-deg",
            )
        })
    }

    /// Panels on which one end of the crease is brighter than the other, or has a different colour.
    fn uneven_ends(&self) -> Option<Doubt> {
        let third = self.grid.cols / 3;
        let ends = |panel, channel| {
            let rows = 0..self.grid.rows;
            let near = self.mean(panel, channel, rows.clone(), |column| column < third)?;
            let far = self.mean(panel, channel, rows, |column| column >= self.grid.cols - third)?;
            Some(Ratio::of(near, far))
        };
        let is_uneven = |panel: usize| {
            let all = (0..self.rgb.channels()).filter_map(|channel| ends(panel, channel));
            extremes(all).is_some_and(|(least, most)| {
                let sd = SURE * least.sd.hypot(most.sd);
                (0.5 * (least.ln + most.ln)).abs() - sd > ENDS_APART
                    || most.ln - least.ln - sd > END_COLOURS_APART
            })
        };
        [0, 1].into_iter().find(|panel| is_uneven(*panel)).map(|panel| {
            Doubt::new(
                format!(
                    "panel {panel} differs between the ends of the crease: a shadow, a lamp nearby, \
                     a pattern, or corners not at the crease"
                ),
                "photograph a sheet of one colour in even light; check with vextract --overlay",
            )
        })
    }

    /// Panels on which every channel is darker next to the crease than at the outer side, beyond the effect
    /// of a stated sky.
    fn darker_at_crease(&self) -> Option<Doubt> {
        let is_darker = |panel: &usize| {
            let rises: Vec<_> = self.rises(*panel).collect();
            let is_dark = |(channel, rise): &(usize, Ratio)| {
                let least = self.expected_rise(*panel, *channel).unwrap_or_default().min(0.0) - DARKER;
                rise.ln + SURE * rise.sd < least
            };
            !rises.is_empty() && rises.iter().all(is_dark)
        };
        let darker: Vec<usize> = [0, 1].into_iter().filter(is_darker).collect();
        let (level, which) = match darker[..] {
            [] => return None,
            [panel] => (Level::Doubtful, format!("panel {panel} is darker at the crease than")),
            _ => (Level::Wrong, "both panels are darker at the crease than".to_owned()),
        };
        Some(Doubt {
            level,
            because: format!(
                "{which} at the outer side: a ridge instead of a valley, corners in another order, \
                 no direct sun, or a lamp nearby"
            ),
            remedy: "check the order of the corners; photograph a valley in direct sunlight".to_owned(),
        })
    }

    /// Panels of two colours, compared where the other panel lights them least.
    fn two_colours(&self) -> Option<Doubt> {
        let (least, most) = extremes(self.panels_apart())?;
        (most.ln - least.ln - SURE * most.sd.hypot(least.sd) > COLOURS_APART).then(|| {
            Doubt::new(
                "the panels have different colours: two sheets, or a coloured object \
                 that reflects light onto one of them",
                "fold one sheet of one colour, away from coloured walls and cloth; \
                 state a card of known colour as panel 1 with --reference-panel",
            )
        })
    }

    /// Increase in brightness of each channel of a panel from the outer side to the crease, in columns that
    /// were measured at both.
    fn rises(&self, panel: usize) -> impl Iterator<Item = (usize, Ratio)> {
        (0..self.rgb.channels()).filter_map(move |channel| Some((channel, self.rise(panel, channel)?)))
    }

    fn rise(&self, panel: usize, channel: usize) -> Option<Ratio> {
        let quarter = self.grid.rows / 4;
        let (inner, outer) = (0..quarter, self.grid.rows - quarter..self.grid.rows);
        let is_measured = |column: usize| {
            let mut all = inner.clone().chain(outer.clone());
            all.all(|row| self.value(panel, row, column, channel).is_some())
        };
        Some(Ratio::of(
            self.mean(panel, channel, inner.clone(), is_measured)?,
            self.mean(panel, channel, outer.clone(), is_measured)?,
        ))
    }

    /// The same for the ideal fold, in all columns.
    fn expected_rise(&self, panel: usize, channel: usize) -> Option<f64> {
        let quarter = self.grid.rows / 4;
        let [inner, outer] = [0..quarter, self.grid.rows - quarter..self.grid.rows]
            .map(|rows| self.expected_sum(panel, channel, rows));
        Some((inner / outer).ln()).filter(|ln| ln.is_finite())
    }

    /// Ratio of brightness, in each channel, between the outer halves of panels 0 and 1, relative to an ideal
    /// fold.
    fn panels_apart(&self) -> impl Iterator<Item = Ratio> {
        let outer = self.grid.rows / 2..self.grid.rows;
        (0..self.rgb.channels()).filter_map(move |channel| {
            let [a, b] = [0, 1].map(|panel| self.mean(panel, channel, outer.clone(), |_| true));
            let [c, d] = [0, 1].map(|panel| self.expected_sum(panel, channel, outer.clone()));
            let Ratio { ln, sd } = Ratio::of(a?, b?);
            Some(Ratio { ln: ln - (c / d).ln(), sd }).filter(|apart| apart.ln.is_finite())
        })
    }

    /// Sum of the ideal fold's facets in some rows.
    fn expected_sum(&self, panel: usize, channel: usize, rows: Range<usize>) -> f64 {
        let facets = self.facet(panel, rows.start, 0)..self.facet(panel, rows.end, 0);
        facets.map(|facet| self.ideal[(facet, channel)]).sum()
    }

    fn facet(&self, panel: usize, row: usize, column: usize) -> usize {
        panel * self.grid.len() + row * self.grid.cols + column
    }

    /// A value and the variance of its noise.
    fn value(&self, panel: usize, row: usize, column: usize, channel: usize) -> Option<(f64, f64)> {
        let facet = self.facet(panel, row, column);
        Some((self.rgb.get(facet, channel)?, self.sd.get(facet, channel)?.powi(2)))
    }

    /// The mean over some rows and columns, and its variance; `None` if there is no light.
    fn mean(
        &self,
        panel: usize,
        channel: usize,
        rows: Range<usize>,
        columns: impl Fn(usize) -> bool,
    ) -> Option<(f64, f64)> {
        let (mut count, mut sum, mut variance) = (0.0, 0.0, 0.0);
        for column in (0..self.grid.cols).filter(|column| columns(*column)) {
            for (value, noise) in rows.clone().filter_map(|row| self.value(panel, row, column, channel)) {
                count += 1.0;
                sum += value;
                variance += noise;
            }
        }
        let mean = sum / count;
        (mean > 0.0).then_some((mean, variance / (count * count)))
    }
}

impl Ratio {
    fn of((a, of_a): (f64, f64), (b, of_b): (f64, f64)) -> Self {
        Self { ln: (a / b).ln(), sd: (of_a / (a * a) + of_b / (b * b)).sqrt() }
    }
}

/// The smallest and the largest ratio.
fn extremes(ratios: impl Iterator<Item = Ratio>) -> Option<(Ratio, Ratio)> {
    let pairs = ratios.map(|ratio| (ratio, ratio));
    pairs.reduce(|(least, most), (ratio, _)| {
        (if ratio.ln < least.ln { ratio } else { least }, if ratio.ln > most.ln { ratio } else { most })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: FacetGrid = FacetGrid { rows: 8, cols: 3 };

    /// Facets whose values are a function of panel, row and channel.
    fn facets(value: impl Fn(usize, usize, usize) -> f64) -> FacetValues {
        let row = |facet: usize| {
            let (panel, row) = (facet / GRID.len(), facet % GRID.len() / GRID.cols);
            Some((0..3).map(|channel| value(panel, row, channel)).collect())
        };
        FacetValues::of_rows(&(0..2 * GRID.len()).map(row).collect::<Vec<_>>()).unwrap()
    }

    /// Levels of doubt about facets where an ideal fold has `ideal`.
    fn levels_beside(
        ideal: impl Fn(usize, usize, usize) -> f64,
        value: impl Fn(usize, usize, usize) -> f64,
    ) -> Vec<Level> {
        let (rgb, sd) = (facets(value), facets(|_, _, _| 1e-4));
        let ideal = DMatrix::from_fn(2 * GRID.len(), 3, |facet, channel| {
            ideal(facet / GRID.len(), facet % GRID.len() / GRID.cols, channel)
        });
        let shading = Shading::new(GRID, &rgb, &sd, &ideal).unwrap();
        shading.doubts(true).iter().map(|doubt| doubt.level).collect()
    }

    fn levels(value: impl Fn(usize, usize, usize) -> f64) -> Vec<Level> {
        levels_beside(|_, row, _| 1.4 - 0.05 * row as f64, value)
    }

    /// A card of another colour as the second panel, or a stated sky, has the same effect as on an ideal
    /// fold.
    #[test]
    fn what_was_stated_is_no_doubt() {
        let with_card =
            |panel, row: usize, channel| (1.4 - 0.05 * row as f64) * (1.0 + 0.4 * (panel * channel) as f64);
        assert_eq!(levels_beside(with_card, |panel, row, channel| 0.3 * with_card(panel, row, channel)), []);
        let under_sky = |_, row: usize, _| 1.0 + 0.05 * row as f64;
        assert_eq!(levels_beside(under_sky, |panel, row, channel| 0.3 * under_sky(panel, row, channel)), []);
    }

    #[test]
    fn a_fold_does_not_fall_towards_its_crease() {
        assert_eq!(levels(|_, row, channel| 0.3 + 0.1 * channel as f64 - 0.01 * row as f64), []);
        assert_eq!(levels(|_, _, _| 0.3), []);
        assert_eq!(levels(|_, row, _| 0.3 + 0.03 * row as f64), [Level::Wrong]);
        let one = |panel, row| if panel == 0 { 0.3 + 0.03 * row as f64 } else { 0.5 - 0.03 * row as f64 };
        assert_eq!(levels(|panel, row, _| one(panel, row)), [Level::Doubtful]);
    }

    #[test]
    fn a_sheet_has_one_colour() {
        let rising = |row: usize| 0.5 - 0.03 * row as f64;
        assert_eq!(levels(|panel, row, _| rising(row) * (1.0 - 0.3 * panel as f64)), []);
        assert_eq!(
            levels(|panel, row, channel| rising(row) * (1.0 + 0.2 * (panel * channel) as f64)),
            [Level::Doubtful]
        );
    }
}
