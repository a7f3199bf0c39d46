//! Shadows on a panel: facets darker than their neighbours and than those opposite, with an edge.
//!
//! The rows of both panels of a fold are alike, however light bounces between them, and other differences
//! between facets are smooth: the logarithm of their brightness is a number for each row plus a few products
//! of position and panel. A shadow is not smooth, and only darkens. Facets far below the rest are left out,
//! the darkest first, until the others agree.

use nalgebra::{DMatrix, DVector};

use super::measured::Measured;
use super::verdict::Doubt;
use crate::geometry::FacetGrid;

/// Facets darker than the rest by this (natural logarithm) are in a shadow: the smallest value that finds
/// none in 48 photographs (`../shared/train`).
const DARK: f64 = 0.07;
/// A facet must also be darker than its noise explains, by this many standard deviations.
const SURE: f64 = 4.0;
/// A shadow covers several squares of two by two facets: wrongly marked corners darken single rows.
const SQUARES: usize = 3;
/// Minimum number of rows and columns for a shadow to have an edge.
const LEAST: usize = 4;
/// Share of all facets that is left out at once, and the minimum share that must remain for comparison.
const AT_ONCE: f64 = 0.04;
const REST: f64 = 0.5;
/// Maximum number of rounds.
const ROUNDS: usize = 30;
/// Regularises rows without measured facets.
const RIDGE: f64 = 1e-9;
/// Number of products of position and panel.
const SMOOTH: usize = 8;

/// A shadow on a panel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shadow {
    /// The panel.
    pub panel: usize,
    /// The facets in and next to it, numbered over both panels.
    pub facets: Vec<usize>,
}

impl Shadow {
    /// The shadows on a fold with these panels, at most one on each.
    ///
    /// # Example
    /// ```
    /// use vfold::estimate::{measured::Measured, shadow::Shadow};
    /// use vfold::forward::FacetValues;
    /// use vfold::geometry::FacetGrid;
    /// let grid = FacetGrid { rows: 10, cols: 10 };
    /// // both panels brighten towards the crease; something shades a corner of panel 1
    /// let shadows = |shade: f64| {
    ///     let value = |facet: usize| {
    ///         let [row, column] = grid.place(facet % 100);
    ///         let light = if facet >= 100 && row >= 6 && column < 4 { shade } else { 1.0 };
    ///         Some(vec![light * (0.5 - 0.02 * row as f64)])
    ///     };
    ///     let rgb = FacetValues::of_rows(&(0..200).map(value).collect::<Vec<_>>()).unwrap();
    ///     let sd = rgb.map(|_, _| 1e-3);
    ///     Shadow::all(grid, &Measured { rgb: &rgb, sd: &sd })
    /// };
    /// assert!(shadows(1.0).is_empty());
    /// assert_eq!(shadows(0.5)[0].panel, 1);
    /// assert_eq!(shadows(0.5)[0].facets.len(), 5 * 5); // with the facets neighbours it
    /// ```
    #[must_use]
    pub fn all(grid: FacetGrid, measured: &Measured) -> Vec<Self> {
        if grid.rows < LEAST || grid.cols < LEAST || measured.rgb.len() != 2 * grid.len() {
            return Vec::new();
        }
        let dark = dark(grid, measured);
        let on_panel = |panel: usize| {
            let own = &dark[panel * grid.len()..][..grid.len()];
            let facets = neighbours(grid, own).map(|facet| panel * grid.len() + facet).collect();
            (squares(grid, own) >= SQUARES).then_some(Self { panel, facets })
        };
        [0, 1].into_iter().filter_map(on_panel).collect()
    }

    /// The doubt that it casts on an estimate: the light from its facets to others is unknown.
    #[must_use]
    pub fn doubt(&self) -> Doubt {
        let (count, panel) = (self.facets.len(), self.panel);
        Doubt::new(
            format!("a shadow lies on panel {panel}, {count} facets of which are left out"),
            "photograph it again without the shadow",
        )
    }
}

/// For each facet, true if it is darker than the rest.
fn dark(grid: FacetGrid, Measured { rgb, sd }: &Measured) -> Vec<bool> {
    let level = |facet: usize| {
        let sum = rgb.facet(facet)?.sum();
        let noise = sd.facet(facet)?.iter().map(|sd| sd * sd).sum::<f64>().sqrt();
        (sum > 0.0).then(|| (sum.ln(), DARK.max(SURE * noise / sum)))
    };
    let levels: Vec<Option<(f64, f64)>> = (0..rgb.len()).map(level).collect();
    let places: Vec<DVector<f64>> = (0..rgb.len()).map(|facet| place(grid, facet)).collect();
    let measured = levels.iter().filter(|level| level.is_some()).count();
    let mut is_kept: Vec<bool> = levels.iter().map(Option::is_some).collect();
    let mut dark = vec![false; rgb.len()];
    for _ in 0..ROUNDS {
        let Some(smooth) = fit(&places, &levels, &is_kept) else { break };
        // depth below the rest, in units of the threshold
        let depth = |facet: usize| levels[facet].map(|(ln, dark)| (smooth.dot(&places[facet]) - ln) / dark);
        let depths: Vec<f64> = (0..rgb.len()).map(|facet| depth(facet).unwrap_or(0.0)).collect();
        dark = (0..rgb.len()).map(|facet| !is_kept[facet] && depths[facet] > 1.0).collect();
        let mut darkest: Vec<usize> =
            (0..rgb.len()).filter(|facet| is_kept[*facet] && depths[*facet] > 1.0).collect();
        darkest.sort_by(|a, b| depths[*b].total_cmp(&depths[*a]));
        darkest.truncate(1 + (AT_ONCE * measured as f64) as usize);
        let rest = is_kept.iter().filter(|kept| **kept).count() - darkest.len();
        if darkest.is_empty() || (rest as f64) < REST * measured as f64 {
            break;
        }
        for facet in (0..rgb.len()).filter(|facet| levels[*facet].is_some() && depths[*facet] < 0.5) {
            is_kept[facet] = true;
        }
        darkest.into_iter().for_each(|facet| is_kept[facet] = false);
    }
    dark
}

/// Regressors of a facet: its row, then products of its position and its panel.
fn place(grid: FacetGrid, facet: usize) -> DVector<f64> {
    let [row, column] = grid.place(facet % grid.len());
    let side = if facet < grid.len() { -1.0 } else { 1.0 };
    let depth = (row as f64 + 0.5) / grid.rows as f64 - 0.5;
    let along = (column as f64 + 0.5) / grid.cols as f64 - 0.5;
    let mut place = DVector::zeros(grid.rows + SMOOTH);
    place[row] = 1.0;
    let smooth: [f64; SMOOTH] = [
        side,
        side * depth,
        side * depth * depth,
        along,
        along * along,
        along * along * depth,
        side * along,
        along * depth,
    ];
    place.rows_mut(grid.rows, SMOOTH).copy_from_slice(&smooth);
    place
}

/// Fits the facets that are kept, by their regressors; `None` if this is impossible.
fn fit(places: &[DVector<f64>], levels: &[Option<(f64, f64)>], is_kept: &[bool]) -> Option<DVector<f64>> {
    let numbers = places.first()?.len();
    let mut products = RIDGE * DMatrix::identity(numbers, numbers);
    let mut sums = DVector::zeros(numbers);
    for ((place, level), _) in places.iter().zip(levels).zip(is_kept).filter(|(_, kept)| **kept) {
        let (ln, _) = (*level)?;
        products.ger(1.0, place, place, 1.0);
        sums.axpy(ln, place, 1.0);
    }
    Some(products.cholesky()?.solve(&sums))
}

/// Number of squares of two by two facets on a panel that are entirely dark.
fn squares(grid: FacetGrid, dark: &[bool]) -> usize {
    let is_dark = |row: usize, column: usize| dark[row * grid.cols + column];
    let is_square = |row: usize, column: usize| {
        [(0, 0), (0, 1), (1, 0), (1, 1)].iter().all(|(down, on)| is_dark(row + down, column + on))
    };
    let all = (0..grid.rows - 1).flat_map(|row| (0..grid.cols - 1).map(move |column| (row, column)));
    all.filter(|(row, column)| is_square(*row, *column)).count()
}

/// Facets of a panel that are dark or next to a dark one, as the edges of shadows are soft.
fn neighbours(grid: FacetGrid, dark: &[bool]) -> impl Iterator<Item = usize> {
    (0..grid.len()).filter(move |facet| {
        let [row, column] = grid.place(*facet);
        let near = |at: usize, end: usize| at.saturating_sub(1)..(at + 2).min(end);
        near(row, grid.rows).any(|row| near(column, grid.cols).any(|column| dark[row * grid.cols + column]))
    })
}
