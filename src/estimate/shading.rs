//! Whether facets are shaded as those of a fold: light that bounces makes both panels brighter towards the crease, and of one colour.
//!
//! These are checks that need no model of a real sheet: where they fail, no spectrum can be measured, however well some model fits.

use nalgebra::DMatrix;

use super::verdict::{Doubt, Level};
use crate::forward::FacetValues;
use crate::geometry::FacetGrid;

/// Rows and columns that panels need for their shading to be seen.
const ROWS_LEAST: usize = 4;
/// Facets beside the crease that are darker than those at the outer sides by this (natural logarithm): a lens darkens corners, a crease
/// is rounded, but neither by so much.
const DARKER: f64 = 0.1;
/// A rise towards the crease that bounces make, and the part of it that is found at least: gloss, bow and lens take and add some.
const RISE: f64 = 0.1;
const RISE_LEAST: f64 = 0.35;
/// The ends of the crease are apart by no more (natural logarithm) in brightness, and in the ratio of two channels: lens, ground and the place of
/// the sun make less.
const ENDS_APART: f64 = 0.18;
const END_COLOURS_APART: f64 = 0.14;
/// Ratios of channels of the panels' outer halves are apart by no more (natural logarithm) in sheets of one colour: sky, ground and the other
/// panel shine on both of them alike.
const COLOURS_APART: f64 = 0.25;
/// A rise towards the crease that a lens, a bow and the ground make without any bounces, and by how much channels differ in it.
const WEAK_RISE: f64 = 0.12;
const WEAK_COLOUR: f64 = 0.012;
/// Panels are no further apart in brightness (natural logarithm) than the sun's place makes them.
const PANELS_APART: f64 = 0.45;
/// Standard deviations from which on a difference is no chance.
const SURE: f64 = 3.0;

/// The facets of a photographed fold.
pub struct Shading<'a> {
    grid: FacetGrid,
    /// Values.
    rgb: &'a FacetValues,
    /// Standard deviations of their noise.
    sd: &'a FacetValues,
}

/// A logarithm of a ratio of means, and its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ratio {
    ln: f64,
    sd: f64,
}

impl<'a> Shading<'a> {
    /// Facets of two panels of such a grid; none if there are too few rows.
    #[must_use]
    pub fn new(grid: FacetGrid, rgb: &'a FacetValues, sd: &'a FacetValues) -> Option<Self> {
        (grid.rows >= ROWS_LEAST && rgb.len() == 2 * grid.len()).then_some(Self { grid, rgb, sd })
    }

    /// What shows that these are no facets of a fold with this spectrum.
    ///
    /// # Arguments
    /// - `ideal`: facets of an ideal fold with the reflectance that was estimated, facet by channel, in any exposure.
    /// - `is_loose`: whether nothing but bounces tells the exposure, in a fold that is not ideal.
    #[must_use]
    pub fn doubts(&self, ideal: &DMatrix<f64>, is_loose: bool) -> Vec<Doubt> {
        let shape = self.darker_at_crease().or_else(|| self.without_bounces(ideal));
        let shape = shape.or_else(|| is_loose.then(|| self.weak_bounces()).flatten());
        let all = [shape, self.two_colours(), self.uneven_ends(), self.uneven_panels(ideal)];
        all.into_iter().flatten().collect()
    }

    /// Panels that rise alike in all channels, by no more than a lens or a bow makes: the same facets without any bounces.
    fn weak_bounces(&self) -> Option<Doubt> {
        let is_weak = |panel: usize| {
            let rises: Vec<Ratio> = self.rises(panel).map(|(_, rise)| rise).collect();
            let least = rises.iter().min_by(|a, b| a.ln.total_cmp(&b.ln));
            let most = rises.iter().max_by(|a, b| a.ln.total_cmp(&b.ln));
            least.zip(most).is_some_and(|(least, most)| {
                most.ln < WEAK_RISE && most.ln - least.ln < WEAK_COLOUR + SURE * least.sd.hypot(most.sd)
            })
        };
        [0, 1].into_iter().all(is_weak).then(|| {
            Doubt::new(
                "no bounces show: both panels change alike in all channels, by no more than a lens or a bow makes, and nothing else tells \
                 the exposure",
                "check that this is a fold; put a white card or a chart in the picture",
            )
        })
    }

    /// Panels that are further apart in brightness than the sun where it was said to stand makes them.
    fn uneven_panels(&self, ideal: &DMatrix<f64>) -> Option<Doubt> {
        let outer = |panel, channel| self.mean(panel, channel, self.grid.rows / 2..self.grid.rows, |_| true);
        let expected = |panel: usize, channel| {
            let facets = self.facet(panel, self.grid.rows / 2, 0)..(panel + 1) * self.grid.len();
            facets.map(|facet| ideal[(facet, channel)]).sum::<f64>()
        };
        let off = |channel: usize| {
            let apart = Ratio::of(outer(0, channel)?, outer(1, channel)?).ln;
            Some(apart - (expected(0, channel) / expected(1, channel)).ln())
        };
        let all: Vec<f64> = (0..self.rgb.channels()).filter_map(off).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        (mean.abs() > PANELS_APART).then(|| {
            Doubt::new(
                format!(
                    "panel {} is {:.1} times as bright beside the other as this sun makes it: a shadow, another light, or a sun far off the middle",
                    usize::from(mean < 0.0),
                    mean.abs().exp()
                ),
                "turn the fold until both panels are equally bright, or state --tilt-deg",
            )
        })
    }

    /// Panels of which one end of the crease is brighter than the other, or has another colour.
    fn uneven_ends(&self) -> Option<Doubt> {
        let third = self.grid.cols / 3;
        let ends = |panel, channel| {
            let rows = 0..self.grid.rows;
            let near = self.mean(panel, channel, rows.clone(), |column| column < third)?;
            let far = self.mean(panel, channel, rows, |column| column >= self.grid.cols - third)?;
            Some(Ratio::of(near, far))
        };
        let is_uneven = |panel: usize| {
            let all: Vec<Ratio> =
                (0..self.rgb.channels()).filter_map(|channel| ends(panel, channel)).collect();
            let least = all.iter().min_by(|a, b| a.ln.total_cmp(&b.ln));
            let most = all.iter().max_by(|a, b| a.ln.total_cmp(&b.ln));
            least.zip(most).is_some_and(|(least, most)| {
                let sd = SURE * least.sd.hypot(most.sd);
                (0.5 * (least.ln + most.ln)).abs() - sd > ENDS_APART
                    || most.ln - least.ln - sd > END_COLOURS_APART
            })
        };
        [0, 1].into_iter().find(|panel| is_uneven(*panel)).map(|panel| {
            Doubt::new(
                format!("panel {panel} is not alike at both ends of the crease: a shadow, a lamp near by, a pattern, or corners not at the crease"),
                "photograph a sheet of one colour, in even light; look at vextract --overlay",
            )
        })
    }

    /// Panels whose every channel is darker beside the crease than at the outer side.
    fn darker_at_crease(&self) -> Option<Doubt> {
        let is_darker = |panel: &usize| {
            let rises: Vec<_> = self.rises(*panel).collect();
            !rises.is_empty() && rises.iter().all(|(_, rise)| rise.ln + SURE * rise.sd < -DARKER)
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
                "{which} at the outer side: a ridge instead of a valley, corners in another order, or no direct sun"
            ),
            remedy: "check the order of the corners; photograph a valley in direct sunlight".to_owned(),
        })
    }

    /// Panels that are not as much brighter towards the crease as bounces on this sheet would make them.
    fn without_bounces(&self, ideal: &DMatrix<f64>) -> Option<Doubt> {
        let is_without = |panel: usize| {
            let brightest = self.rises(panel).max_by(|a, b| {
                let expected =
                    |channel| self.expected_rise(ideal, panel, channel).unwrap_or(f64::NEG_INFINITY);
                expected(a.0).total_cmp(&expected(b.0))
            });
            brightest.is_some_and(|(channel, rise)| {
                let expected = self.expected_rise(ideal, panel, channel).unwrap_or_default();
                expected > RISE && rise.ln + SURE * rise.sd < RISE_LEAST * expected
            })
        };
        [0, 1].into_iter().all(is_without).then(|| Doubt {
            level: Level::Wrong,
            because: "neither panel is brighter towards the crease, as light that bounces would make it: a flat sheet, corners \
                      elsewhere than at the crease, or an exposure that is not true"
                .to_owned(),
            remedy: "check that the sheet is folded, the corners and the exposure".to_owned(),
        })
    }

    /// Panels of two colours where the other panel shines least on them.
    fn two_colours(&self) -> Option<Doubt> {
        let outer = |panel, channel| self.mean(panel, channel, self.grid.rows / 2..self.grid.rows, |_| true);
        let apart: Vec<Ratio> = (0..self.rgb.channels())
            .filter_map(|channel| Some(Ratio::of(outer(0, channel)?, outer(1, channel)?)))
            .collect();
        let most = apart.iter().max_by(|a, b| a.ln.total_cmp(&b.ln))?;
        let least = apart.iter().min_by(|a, b| a.ln.total_cmp(&b.ln))?;
        (most.ln - least.ln - SURE * most.sd.hypot(least.sd) > COLOURS_APART).then(|| {
            Doubt::new(
                "the panels have different colours: two sheets, or a coloured thing that shines on one of them",
                "fold one sheet of one colour, away from coloured walls and cloth; a card of known colour as panel 1 is given by \
                 --reference-panel",
            )
        })
    }

    /// By how much each channel of a panel is brighter beside the crease than at the outer side, columns that were measured at both alone.
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

    /// The same of the ideal fold, in all columns.
    fn expected_rise(&self, ideal: &DMatrix<f64>, panel: usize, channel: usize) -> Option<f64> {
        let quarter = self.grid.rows / 4;
        let sum = |rows: std::ops::Range<usize>| -> f64 {
            let facets = rows.flat_map(|row| (0..self.grid.cols).map(move |column| (row, column)));
            facets.map(|(row, column)| ideal[(self.facet(panel, row, column), channel)]).sum()
        };
        let ln = (sum(0..quarter) / sum(self.grid.rows - quarter..self.grid.rows)).ln();
        ln.is_finite().then_some(ln)
    }

    fn facet(&self, panel: usize, row: usize, column: usize) -> usize {
        panel * self.grid.len() + row * self.grid.cols + column
    }

    /// A value and the variance of its noise.
    fn value(&self, panel: usize, row: usize, column: usize, channel: usize) -> Option<(f64, f64)> {
        let facet = self.facet(panel, row, column);
        Some((self.rgb.get(facet, channel)?, self.sd.get(facet, channel)?.powi(2)))
    }

    /// The mean over some rows and columns, and its variance; none if there is no light.
    fn mean(
        &self,
        panel: usize,
        channel: usize,
        rows: std::ops::Range<usize>,
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

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: FacetGrid = FacetGrid { rows: 8, cols: 3 };

    /// Facets whose value is a function of panel, row and channel.
    fn facets(value: impl Fn(usize, usize, usize) -> f64) -> FacetValues {
        let row = |facet: usize| {
            let (panel, row) = (facet / GRID.len(), facet % GRID.len() / GRID.cols);
            Some((0..3).map(|channel| value(panel, row, channel)).collect())
        };
        FacetValues::of_rows(&(0..2 * GRID.len()).map(row).collect::<Vec<_>>()).unwrap()
    }

    fn levels(value: impl Fn(usize, usize, usize) -> f64) -> Vec<Level> {
        let (rgb, sd) = (facets(value), facets(|_, _, _| 1e-4));
        let bounces = |row: usize| 1.4 - 0.05 * row as f64;
        let ideal = DMatrix::from_fn(2 * GRID.len(), 3, |facet, _| bounces(facet % GRID.len() / GRID.cols));
        Shading::new(GRID, &rgb, &sd).unwrap().doubts(&ideal, false).iter().map(|doubt| doubt.level).collect()
    }

    #[test]
    fn a_fold_rises_towards_its_crease() {
        assert_eq!(levels(|_, row, channel| 0.3 + 0.1 * channel as f64 - 0.01 * row as f64), []);
        assert_eq!(levels(|_, _, _| 0.3), [Level::Wrong]);
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
