//! The exchange between distant clusters that see each other, without a matrix.
//!
//! The kernel of eq. (2) is `(n·d)(−n'·d)/(π d⁴)`, with `d` from one point to the other: apart from the
//! normals it is smooth for distant clusters, and is evaluated at the nodes of a [`Grid`] in each. The light
//! leaving a cluster is gathered in one vector per node (its patches' light times their normals), propagated
//! to the nodes of others, and projected there onto the normals of their patches. Larger clusters gather from
//! their halves, and halves interpolate what arrives at the whole, so that weights are stored only for the
//! smallest clusters.
//!
//! Source: Hackbusch and Börm, *H²-matrix approximation of integral operators by interpolation*, Appl. Numer.
//! Math. 43 (2002), p. 129; Hackbusch, *Hierarchical Matrices: Algorithms and Analysis* (2015), chapter 8.

use std::f64::consts::PI;
use std::ops::Range;

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::cluster::Tree;
use super::far::nodes;
use super::grid::Grid;
use super::site::Site;
use crate::geometry::Vec3;

/// Clusters that are distant from others, each before its halves.
#[derive(Clone, Debug, Default)]
pub(super) struct FarField {
    parts: Vec<Part>,
    /// Normal of the patch at every position.
    normals: Vec<Vec3>,
}

#[derive(Clone, Debug)]
struct Part {
    grid: Grid,
    /// The cluster of which this is a half, if that has distant partners.
    whole: Option<usize>,
    /// Its distant partners.
    partners: Vec<usize>,
    /// Weights of its nodes on its patches, if it has no halves.
    leaf: Option<Leaf>,
}

#[derive(Clone, Debug)]
struct Leaf {
    patches: Range<usize>,
    /// Integrals over every patch divided by the square root of its area: node by patch.
    weights: DMatrix<f32>,
}

/// One vector per node of every part; empty where there are none.
type Vectors = Vec<Vec<Vec3>>;

impl FarField {
    /// The exchange of pairs of clusters in `tree`, accurate to `tolerance` times the exchange that they
    /// would have if they faced each other.
    pub(super) fn new(tree: &Tree, sites: &[Site], pairs: &[[usize; 2]], tolerance: f64) -> Self {
        let mut partners = vec![Vec::new(); tree.clusters.len()];
        for [a, b] in pairs {
            partners[*a].push(*b);
            partners[*b].push(*a);
        }
        let mut whole = vec![None; tree.clusters.len()];
        let mut numbers = Vec::new();
        for (n, cluster) in tree.clusters.iter().enumerate() {
            if !partners[n].is_empty() || whole[n].is_some() {
                numbers.push(n);
                cluster.halves.into_iter().flatten().for_each(|half| whole[half] = Some(n));
            }
        }
        let place = |n: &usize| numbers.partition_point(|number| number < n);
        let part = |n: &usize| {
            let cluster = &tree.clusters[*n];
            let grid = Grid::new(&cluster.cuboid, tolerance);
            let leaf = cluster.halves.is_none().then(|| Leaf::new(&grid, sites, cluster.patches.clone()));
            let partners = partners[*n].iter().map(place).collect();
            Part { grid, whole: whole[*n].as_ref().map(place), partners, leaf }
        };
        let parts = numbers.par_iter().map(part).collect();
        Self { parts, normals: sites.iter().map(|site| site.plane.normal).collect() }
    }

    /// Number of stored numbers.
    pub(super) fn len(&self) -> usize {
        self.parts.iter().filter_map(|part| part.leaf.as_ref()).map(|leaf| leaf.weights.len()).sum()
    }

    /// Adds the product of the exchange with `x` to `out`, both in the order of the tree.
    pub(super) fn add_product(&self, x: &[f64], out: &mut [f64]) {
        let fields = self.arriving(&self.leaving(x));
        for (part, field) in self.parts.iter().zip(&fields).filter(|(_, field)| !field.is_empty()) {
            let Some(leaf) = &part.leaf else { continue };
            for (patch, weights) in leaf.patches() {
                let light: Vec3 = weights.iter().zip(field).map(|(weight, v)| f64::from(*weight) * v).sum();
                out[patch] += light.dot(&self.normals[patch]);
            }
        }
    }

    /// The light leaving every cluster.
    fn leaving(&self, x: &[f64]) -> Vectors {
        let of_leaf =
            |part: &Part| part.leaf.as_ref().map_or_else(Vec::new, |leaf| self.gathered(part, leaf, x));
        let mut leaving: Vectors = self.parts.par_iter().map(of_leaf).collect();
        for (n, part) in self.parts.iter().enumerate().rev() {
            let Some(whole) = part.whole.filter(|_| !leaving[n].is_empty()) else { continue };
            let (before, from) = leaving.split_at_mut(n);
            let grid = &self.parts[whole].grid;
            before[whole].resize(grid.nodes.len(), Vec3::zeros());
            for (node, vector) in part.grid.nodes.iter().zip(&from[0]) {
                grid.weights(node)
                    .iter()
                    .zip(&mut before[whole])
                    .for_each(|(weight, sum)| *sum += *weight * vector);
            }
        }
        leaving
    }

    fn gathered(&self, part: &Part, leaf: &Leaf, x: &[f64]) -> Vec<Vec3> {
        if x[leaf.patches.clone()].iter().all(|x| *x == 0.0) {
            return vec![];
        }
        let mut sums = vec![Vec3::zeros(); part.grid.nodes.len()];
        for (patch, weights) in leaf.patches() {
            let vector = x[patch] * self.normals[patch];
            sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += f64::from(*weight) * vector);
        }
        sums
    }

    /// The light arriving at every cluster.
    fn arriving(&self, leaving: &Vectors) -> Vectors {
        let from_afar = |part: &Part| {
            let mut field = Vec::new();
            for other in part.partners.iter().filter(|other| !leaving[**other].is_empty()) {
                field.resize(part.grid.nodes.len(), Vec3::zeros());
                carry(&self.parts[*other].grid.nodes, &leaving[*other], &part.grid.nodes, &mut field);
            }
            field
        };
        let mut fields: Vectors = self.parts.par_iter().map(from_afar).collect();
        for (n, part) in self.parts.iter().enumerate() {
            let Some(whole) = part.whole.filter(|whole| !fields[*whole].is_empty()) else { continue };
            let (before, own) = fields.split_at_mut(n);
            let grid = &self.parts[whole].grid;
            own[0].resize(part.grid.nodes.len(), Vec3::zeros());
            for (node, field) in part.grid.nodes.iter().zip(&mut own[0]) {
                *field += grid
                    .weights(node)
                    .iter()
                    .zip(&before[whole])
                    .map(|(weight, v)| *weight * v)
                    .sum::<Vec3>();
            }
        }
        fields
    }
}

/// Adds the fields of vectors at some points to others: `−d (d·v) / (π d⁴)`.
fn carry(from: &[Vec3], vectors: &[Vec3], to: &[Vec3], fields: &mut [Vec3]) {
    for (point, field) in to.iter().zip(fields) {
        let mut sum = Vec3::zeros();
        for (source, vector) in from.iter().zip(vectors) {
            let d = source - point;
            let square = d.norm_squared();
            sum -= d * (d.dot(vector) / (square * square));
        }
        *field += sum / PI;
    }
}

impl Leaf {
    fn new(grid: &Grid, sites: &[Site], patches: Range<usize>) -> Self {
        // polynomials along the axes are integrated exactly on parallelograms
        let order = grid.order().div_ceil(2);
        let of_patch = |site: &Site| {
            let mut sums = vec![0.0; grid.nodes.len()];
            for (point, area) in nodes(&site.polygon, order) {
                let share = area / site.polygon.area().sqrt();
                sums.iter_mut().zip(grid.weights(&point)).for_each(|(sum, weight)| *sum += share * weight);
            }
            sums.into_iter().map(|sum| sum as f32)
        };
        let weights = sites[patches.clone()].iter().flat_map(of_patch);
        Self { weights: DMatrix::from_iterator(grid.nodes.len(), patches.len(), weights), patches }
    }

    /// Every patch with the weights of the nodes.
    fn patches(&self) -> impl Iterator<Item = (usize, &[f32])> {
        self.patches.clone().zip(self.weights.column_iter().map(|weights| weights.data.into_slice()))
    }
}
