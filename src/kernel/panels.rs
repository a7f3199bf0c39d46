//! Light that undivided panels of a fold pass to each other in one bounce, which every mesh must reproduce.

use nalgebra::DMatrix;

use super::wedge::Wedge;
use crate::geometry::Fold;
use crate::response::{ModeSet, Modes, Response};

/// Largest relative difference from the closed form: coarse meshes have far less, and a wrong angle, more.
const SAME: f64 = 2e-4;
/// A flat sheet passes on nothing, and rounding a little.
const NOTHING: f64 = 1e-12;

/// Whether the first bounce of `response` is that of `fold`.
#[must_use]
pub fn is_of_fold(response: &Response, fold: &Fold) -> bool {
    let depths = fold.depths().map(|depth| depth / fold.width());
    let mut exchange = [0.0];
    Wedge::new(fold).exchange(&(0.0..depths[0]), &(0.0..depths[1]), &mut exchange);
    let facets = fold.facets().len();
    let received = match response.modes() {
        Modes::Shared(set) => vec![(0, first_bounce(set, 0, fold, 0))],
        Modes::Separate([on_0, on_1]) => {
            vec![(1, first_bounce(on_0, facets, fold, 1)), (0, first_bounce(on_1, 0, fold, 0))]
        }
    };
    received.into_iter().all(|(panel, received)| {
        let expected = exchange[0] / depths[panel];
        (received - expected).abs() <= SAME * expected + NOTHING
    })
}

/// Mean of the light of one bounce over a panel whose facets begin at `first`, unit light on the other.
fn first_bounce(set: &ModeSet, first: usize, fold: &Fold, panel: usize) -> f64 {
    let edges = &fold.row_edges()[panel];
    let facets = fold.facets();
    let area = |facet: usize| {
        let [row, _] = facets.place(facet);
        (edges[row + 1] - edges[row]) / (edges[facets.rows] * facets.cols as f64)
    };
    let residues: &DMatrix<f64> = &set.residues;
    let light = |facet: usize| {
        set.poles.iter().zip(residues.row(first + facet).iter()).map(|(pole, part)| pole * part).sum::<f64>()
    };
    (0..facets.len()).map(|facet| area(facet) * light(facet)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{FacetGrid, Spacing};
    use crate::kernel::mesh::respond;

    #[test]
    fn a_response_is_that_of_its_own_fold_alone() {
        let grid = FacetGrid { rows: 4, cols: 3 };
        for (angle_deg, depth, depth1) in
            [(50.0, 1.0, 1.0), (5.0, 0.1, 0.1), (120.0, 1.0, 0.4), (175.0, 3.0, 2.0)]
        {
            for spacing in [Spacing::Uniform, Spacing::Graded] {
                let fold = Fold::new(angle_deg, 1.0, depth, grid).unwrap();
                let fold = fold.with_panel1_depth(depth1).unwrap().with_spacing(spacing);
                for tolerance in [1e-1, 1e-6] {
                    let (response, _) = respond(&fold, tolerance).unwrap();
                    assert!(is_of_fold(&response, &fold), "{fold:?} {tolerance}");
                    let other = fold.with_angle_deg(angle_deg + 0.5).unwrap();
                    assert!(!is_of_fold(&response, &other), "{fold:?} {tolerance}");
                }
            }
        }
    }

    #[test]
    fn a_flat_sheet_passes_on_nothing() {
        let grid = FacetGrid { rows: 2, cols: 2 };
        let flat = Fold::new(180.0, 1.0, 1.0, grid).unwrap();
        let (response, _) = respond(&flat, 1e-5).unwrap();
        assert!(is_of_fold(&response, &flat));
        assert!(!is_of_fold(&response, &flat.with_angle_deg(170.0).unwrap()));
    }
}
