//! All pairs of patches, cluster by cluster: whatever holds for two clusters is not tested for their patches.
//!
//! Clusters that face away from each other, or are separated by one wall, exchange nothing. Distant clusters
//! that see each other completely exchange light through [`FarField`](super::far_field::FarField). Only the
//! remaining ones are computed pair by pair.

use rayon::prelude::*;

use super::assembly::Assembly;
use super::block::Block;
use super::cluster::{Cluster, Side, Tree};
use super::grid::{GAP, orders};

/// Cost of a pair of patches, in pairs of nodes.
const PAIR: usize = 8;

/// The exchange of two clusters.
enum Part {
    Near(Block),
    /// Their numbers.
    Far([usize; 2]),
}

/// The clusters of all patches, for computing their exchange.
pub(super) struct Hierarchy<'a> {
    pub(super) assembly: &'a Assembly,
    pub(super) tree: &'a Tree,
    /// Error of the far field.
    pub(super) truncation: f64,
}

impl Hierarchy<'_> {
    /// The exchange of all pairs of patches: blocks of near ones, and the numbers of distant clusters that
    /// see each other.
    pub(super) fn parts(&self) -> (Vec<Block>, Vec<[usize; 2]>) {
        let (mut blocks, mut pairs) = (Vec::new(), Vec::new());
        for part in self.between([0, 0], &self.assembly.casters.numbers()) {
            match part {
                Part::Near(block) => blocks.push(block),
                Part::Far(pair) => pairs.push(pair),
            }
        }
        (blocks, pairs)
    }

    /// The exchange of two clusters, of which some of `candidates` may hide parts.
    fn between(&self, pair: [usize; 2], candidates: &[usize]) -> Vec<Part> {
        let (assembly, margin) = (self.assembly, self.assembly.casters.margin());
        let [a, b] = pair.map(|n| &self.tree.clusters[n]);
        let sides = [a.side(b, margin), b.side(a, margin)];
        if sides.contains(&Side::Behind) {
            assembly.count_averted(pairs(a, b));
            return vec![];
        }
        let Some(casters) = self.casters(pair, candidates) else {
            assembly.count_walled(pairs(a, b));
            return vec![];
        };
        let is_far = casters.is_empty() && sides == [Side::Front; 2] && is_smooth(a, b);
        if is_far && self.is_cheaper(a, b) {
            assembly.count_open(pairs(a, b));
            return vec![Part::Far(pair)];
        }
        let parts = parts(pair, [a, b]);
        if is_far || parts.is_empty() {
            let block = assembly.block(a.patches.clone(), b.patches.clone(), &casters);
            return block.map(Part::Near).into_iter().collect();
        }
        parts.into_par_iter().flat_map(|pair| self.between(pair, &casters)).collect()
    }

    /// Those of `candidates` that may hide part of one cluster from part of the other; none if one hides
    /// everything.
    fn casters(&self, pair: [usize; 2], candidates: &[usize]) -> Option<Vec<usize>> {
        let [a, b] = pair.map(|n| &self.tree.clusters[n]);
        let casters = &self.assembly.casters;
        let near = casters.between_boxes(&a.bounds, &b.bounds, candidates);
        let near = casters.between_hulls(&a.cuboid.corners(), &b.cuboid.corners(), &near)?;
        let is_behind = |plane| {
            pair.iter().any(|n| self.tree.is_behind(*n, &self.assembly.sites, plane, casters.margin()))
        };
        Some(near.into_iter().filter(|n| is_behind(casters.plane(*n))).collect())
    }

    /// Whether propagation between nodes is cheaper than all pairs of patches.
    fn is_cheaper(&self, a: &Cluster, b: &Cluster) -> bool {
        let nodes = |cluster: &Cluster| orders(&cluster.cuboid, self.truncation).iter().product::<usize>();
        nodes(a) * nodes(b) <= PAIR * pairs(a, b)
    }
}

/// Number of pairs of patches.
fn pairs(a: &Cluster, b: &Cluster) -> usize {
    let (a, b) = (&a.patches, &b.patches);
    if a == b { a.len() * (a.len() - 1) / 2 } else { a.len() * b.len() }
}

/// Whether both are even, and far apart relative to their size.
fn is_smooth(a: &Cluster, b: &Cluster) -> bool {
    let reach = a.cuboid.reach().max(b.cuboid.reach());
    a.is_even && b.is_even && a.cuboid.gap(&b.cuboid) >= GAP * reach
}

/// The pairs of their halves, each once, or of the halves of the larger; empty if there are no halves.
fn parts([n, m]: [usize; 2], [a, b]: [&Cluster; 2]) -> Vec<[usize; 2]> {
    match (a.halves, b.halves) {
        (Some([low, high]), _) if n == m => vec![[low, low], [low, high], [high, high]],
        (Some(halves), None) => halves.map(|half| [half, m]).into(),
        (Some(halves), Some(_)) if a.cuboid.reach() >= b.cuboid.reach() => {
            halves.map(|half| [half, m]).into()
        }
        (_, Some(halves)) => halves.map(|half| [n, half]).into(),
        (None, None) => vec![],
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::{FacetGrid, Fold};
    use crate::surfaces::accordion::Accordion;
    use crate::surfaces::kernel::SurfaceKernel;
    use crate::surfaces::kernel::patches::{Division, patches};
    use crate::surfaces::{Exchange, Shape};

    fn fold(creases: usize, facets: usize) -> Shape {
        let valley = Fold::new(100.0, 1.0, 1.0, FacetGrid { rows: facets, cols: facets }).unwrap();
        Accordion { valley, creases, ridge_deg: 120.0, bow_deg: 0.0 }.shape().unwrap()
    }

    /// The panels of a fold with three creases see each other past the ridge: completely, partly and not at
    /// all.
    #[test]
    fn clusters_exchange_what_their_patches_do() {
        let (shape, tolerance) = (fold(3, 16), 1e-2);
        let patches = patches(&shape, Division::NONE);
        let pairs = SurfaceKernel::by_pairs(&shape, &patches, tolerance).unwrap();
        let clusters = SurfaceKernel::by_clusters(&shape, &patches, tolerance).unwrap();
        assert_eq!(pairs.census(), clusters.census());
        assert!(pairs.census().hidden > 0 && pairs.census().walled > 0);
        assert!(clusters.far_field.len() > 0);
        for row in (0..shape.len()).step_by(97) {
            let (want, found) = (pairs.matrix_row(row), clusters.matrix_row(row));
            let off: f64 = want.iter().zip(&found).map(|(a, b)| (a - b).abs()).sum();
            assert!(off < 0.01 * tolerance, "row {row}: {off:.1e}");
        }
    }

    #[test]
    fn a_row_is_what_one_bright_patch_gives() {
        let shape = fold(1, 20);
        let kernel = SurfaceKernel::by_clusters(&shape, &patches(&shape, Division::NONE), 1e-3).unwrap();
        let (mut unit, mut out) = (vec![0.0; shape.len()], vec![0.0; shape.len()]);
        unit[210] = 1.0;
        kernel.apply(&unit, &mut out);
        let (roots, row) = (kernel.root_areas(), kernel.matrix_row(210));
        for (other, (out, share)) in out.iter().zip(row).enumerate() {
            assert!((out * roots[other] / roots[210] - share).abs() < 1e-15, "{other}");
        }
    }
}
