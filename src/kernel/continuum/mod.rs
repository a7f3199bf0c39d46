//! Interreflections between two undivided panels: eqs. (1) to (4) without facets.
//!
//! One flat patch per facet is 5 % off at the crease of a bright 45° fold, however exact its form factors.
//! Here the radiosity is instead a function on the panel: a polynomial in both directions on each of a few
//! cells (Galerkin's method, `space`). Cells narrow geometrically towards the crease and its ends, where
//! light varies as a power of the distance, and in narrow folds towards the outer edges, where it escapes. A
//! few more polynomials then divide the error by ten, wherever that is needed.
//!
//! Facets are read one bounce later: the radiosity determines the light on their whole area, in which most of
//! its error averages out. A second set of functions represents that light (`reading`).
//!
//! An entry integrates the kernel over two strips along the crease and two across it. Along the crease only
//! the shift `z = x − y` matters (`correlation`), and the result depends only on the distance q across it
//! (`table`); the integrals across become weights of that function's values (`rows`), and all entries of two
//! rows are a few matrix products (`blocks`). Non-negligible entries are kept (`compressed`) and multiplied
//! (`exchange`). Lengths are in units of panel 0's depth.

mod blocks;
mod compressed;
mod correlation;
mod exchange;
mod layout;
mod nodes;
mod reading;
mod resolution;
mod rows;
mod space;
mod strips;
mod table;

use nalgebra::{DMatrix, DMatrixView, DVectorView};

pub use self::resolution::Resolution;

use self::blocks::Blocks;
use self::exchange::Exchange;
use self::layout::Layout;
use self::reading::Reading;
use self::table::tabulate;
use crate::geometry::{FacetGrid, Fold};
use crate::response::PanelOperator;

/// The radiosity operator of a fold, and the light that its functions throw on the facets.
pub struct Continuum {
    exchange: Exchange,
    uniform: [Vec<f64>; 2],
    facets: FacetGrid,
    reading: Reading,
    /// For each panel (only the first if they are alike): receiving function by function of the other panel.
    views: Vec<DMatrix<f64>>,
}

impl Continuum {
    /// Discretises the exchange between the panels of `fold`.
    ///
    /// # Source
    /// Deeb et al., eq. (2), as the kernel of the integral equation iterated by eqs. (1) to (4). Facets are
    /// read as in the improvement of Galerkin's method by Sloan, *Improvement by iteration for compact
    /// operator equations* (1976).
    #[must_use]
    pub fn new(fold: &Fold, resolution: &Resolution) -> Self {
        let layout = Layout::new(fold, resolution);
        let nodes = layout.nodes(fold, resolution.nodes);
        let [panel0, panel1] = &layout.panels;
        let alike = fold.is_symmetric();
        let reading = Reading::new(&layout, fold);
        let table = tabulate(&panel0.along, &panel1.along, layout.width, &nodes);
        let blocks = Blocks::new(fold, [panel0, panel1], &nodes, &table);
        let exchange = blocks.exchange(alike, resolution.negligible);
        let table = tabulate(&reading.spaces[0].along, &panel1.along, layout.width, &nodes);
        let view = |panel: usize| {
            let spaces = [&reading.spaces[panel], &layout.panels[1 - panel]];
            Blocks::new(fold, spaces, &nodes, &table).dense()
        };
        Self {
            exchange,
            uniform: [panel0.uniform(), panel1.uniform()],
            facets: fold.facets(),
            views: (0..if alike { 1 } else { 2 }).map(view).collect(),
            reading,
        }
    }
}

impl PanelOperator for Continuum {
    const AFTER_A_BOUNCE: bool = true;

    fn is_symmetric(&self) -> bool {
        self.exchange.unlike.is_none()
    }

    fn uniform(&self, panel: usize) -> Vec<f64> {
        self.uniform[panel].clone()
    }

    fn apply(&self, panel: usize, x: &[f64], out: &mut [f64]) {
        self.exchange.apply(panel, x, out);
    }

    fn apply_both(&self, x: [&[f64]; 2], out: [&mut [f64]; 2]) {
        self.exchange.apply_both(x, out);
    }

    fn facet_means(&self, panel: usize, x: &[f64]) -> Vec<f64> {
        let FacetGrid { rows, cols } = self.facets;
        // One view serves both panels if they are alike.
        let view = &self.views[panel % self.views.len()];
        let light = view * DVectorView::from_slice(x, x.len());
        let means = self.reading.facet_means(panel, light.as_slice());
        let means = DMatrixView::from_slice(&means, cols.div_ceil(2), rows);
        // Light is symmetric along the crease: its second half is the mirror image of the first.
        DMatrix::from_fn(cols, rows, |col, row| means[(col.min(cols - 1 - col), row)]).data.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::dot;

    /// Form factors of panel 0 to panel 1 by another method, to 20 digits: Howell's configuration C-16.
    #[test]
    fn panels_exchange_what_their_form_factors_say() {
        let cases = [
            (1.0, [1.0, 1.0, 1.0], 0.98299717857467),
            (45.0, [1.0, 1.0, 1.0], 0.48334769547888),
            (45.0, [1.0, 0.5, 3.0], 0.67707979386622),
            (60.0, [2.0, 1.0, 1.0], 0.43013140870230),
            (90.0, [1.0, 2.0, 1.0], 0.11642630139768),
            (150.0, [1.0, 1.0, 1.0], 0.02134532541269),
        ];
        for (angle_deg, [width, depth0, depth1], want) in cases {
            let facets = FacetGrid { rows: 3, cols: 5 };
            let fold =
                Fold::new(angle_deg, width, depth0, facets).unwrap().with_panel1_depth(depth1).unwrap();
            let continuum = Continuum::new(&fold, &Resolution::reaching(1e-6, &fold));
            let [even0, even1] = [0, 1].map(|panel| continuum.uniform(panel));
            let mut light = vec![0.0; even0.len()];
            continuum.apply(0, &even1, &mut light);
            let factor = dot(&even0, &light) / dot(&even0, &even0);
            assert!((factor / want - 1.0).abs() < 1e-7, "{angle_deg}°: {factor} between functions");
            let means = continuum.facet_means(0, &even1);
            let factor = means.iter().sum::<f64>() / means.len() as f64;
            assert!((factor / want - 1.0).abs() < 1e-7, "{angle_deg}°: {factor} on facets");
        }
    }

    /// Many facets, which are read from polynomials, agree with few, which receive the light themselves, to
    /// half of the target error.
    #[test]
    fn many_facets_are_parts_of_few() {
        for (angle_deg, depth1) in [(20.0, 1.0), (45.0, 0.6), (120.0, 1.0)] {
            let [few, many] = [1, 16].map(|parts| {
                let facets = FacetGrid { rows: 5 * parts, cols: 6 * parts };
                Fold::new(angle_deg, 1.0, 1.0, facets).unwrap().with_panel1_depth(depth1).unwrap()
            });
            let resolution = Resolution::reaching(1e-6, &few);
            let [few, many] = [few, many].map(|fold| Continuum::new(&fold, &resolution));
            let read = many.reading.len();
            assert!(few.reading.len() < read && read < 80 * 48, "{angle_deg}°: {read}");
            for panel in 0..2 {
                let even = few.uniform(1 - panel);
                let [few, many] = [&few, &many].map(|continuum| continuum.facet_means(panel, &even));
                for (facet, mean) in few.iter().enumerate() {
                    let (row, col) = (facet / 6, facet % 6);
                    let part = |n: usize| many[(16 * row + n / 16) * 96 + 16 * col + n % 16];
                    let parts = (0..256).map(part).sum::<f64>() / 256.0;
                    assert!(
                        (parts / mean - 1.0).abs() < 5e-7,
                        "{angle_deg}°, facet {facet}: {parts}, {mean}"
                    );
                }
            }
        }
    }
}
