//! Skips on the way to the form factors.

use std::f64::consts::PI;
use std::ops::Range;

use vfold::kernel::wedge::Wedge;
use vfold::paper::{FoldKernel, form_factors};

use super::{ANGLE_DEG, Skip};
use crate::common::fold;

const N: usize = 10;
const ROUNDING: f64 = 1e-12;

pub fn rows() -> Vec<String> {
    let mut rows = vec![visibility(), empty_blocks()];
    rows.extend([10, 16].map(repeated_pairs));
    rows
}

type Point = [f64; 3];

/// A facet in space: its corners, its centre and the unit normal of its inner side. Lengths are in facet
/// widths.
struct Facet {
    corners: [Point; 4],
    centre: Point,
    normal: Point,
}

/// All facets of both panels of `n` x `n`, in the kernel's order.
fn facets(n: usize) -> Vec<Facet> {
    let (sin, cos) = ANGLE_DEG.to_radians().sin_cos();
    let facet = |panel: usize, row: usize, col: usize| {
        let at = |x: f64, s: f64| if panel == 0 { [x, s, 0.0] } else { [x, s * cos, s * sin] };
        let (x, s) = (col as f64, row as f64);
        Facet {
            corners: [at(x, s), at(x + 1.0, s), at(x + 1.0, s + 1.0), at(x, s + 1.0)],
            centre: at(x + 0.5, s + 0.5),
            normal: if panel == 0 { [0.0, 0.0, 1.0] } else { [0.0, sin, -cos] },
        }
    };
    let of_panel = |panel| (0..n * n).map(move |k| facet(panel, k / n, k % n));
    (0..2).flat_map(of_panel).collect()
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Whether each of two facets is before the other's plane and none of `others` cuts the ray between their
/// centres.
fn see(a: &Facet, b: &Facet, others: &[Facet]) -> bool {
    let before = |of: &Facet, from: &Facet| {
        of.corners.iter().any(|corner| dot(minus(*corner, from.centre), from.normal) > ROUNDING)
    };
    let ray = minus(b.centre, a.centre);
    before(a, b) && before(b, a) && !others.iter().any(|other| cuts(other, a.centre, ray))
}

/// Whether a facet cuts the ray from `start` to `start + ray` on its way.
fn cuts(facet: &Facet, start: Point, ray: Point) -> bool {
    let along = dot(minus(facet.centre, start), facet.normal) / dot(ray, facet.normal);
    if !(along > ROUNDING && along < 1.0 - ROUNDING) {
        return false;
    }
    let hit: Point = std::array::from_fn(|k| start[k] + along * ray[k]);
    let [corner, next, _, previous] = facet.corners;
    [next, previous].into_iter().all(|end| {
        let side = minus(end, corner);
        (0.0..dot(side, side)).contains(&dot(minus(hit, corner), side))
    })
}

/// Form factors from all facets of panel 0 to all of panel 1.
fn block(kernel: &FoldKernel) -> Vec<f64> {
    let count = kernel.facets().len();
    (0..count).flat_map(|facet| kernel.matrix_row(facet).split_off(count)).collect()
}

fn visibility() -> String {
    let fold = fold(ANGLE_DEG, N);
    let tested = || {
        let (all, mut entries) = (facets(N), block(&form_factors(&fold)));
        for (k, entry) in entries.iter_mut().enumerate() {
            if !see(&all[k / (N * N)], &all[N * N + k % (N * N)], &all) {
                *entry = 0.0;
            }
        }
        entries
    };
    let skip = Skip::new(
        "visibility tests",
        "two half-spaces per pair of facets and its ray against all 200, then the kernel",
        "the kernel: panels of a fold see each other whole",
    );
    skip.row(tested, || block(&form_factors(&fold)))
}

/// Eq. (2) at the centres, for any two facets in space.
fn at_centres(a: &Facet, b: &Facet) -> f64 {
    let ray = minus(b.centre, a.centre);
    let (cos_a, cos_b) = (dot(ray, a.normal), -dot(ray, b.normal));
    let distance2 = dot(ray, ray);
    if cos_a <= 0.0 || cos_b <= 0.0 { 0.0 } else { cos_a * cos_b / (PI * distance2 * distance2) }
}

fn empty_blocks() -> String {
    let all = facets(N);
    let count = all.len();
    let matrix = |others: &dyn Fn(usize) -> Range<usize>| {
        let mut matrix = vec![0.0; count * count];
        for a in 0..count {
            for b in others(a) {
                matrix[a * count + b] = at_centres(&all[a], &all[b]);
            }
        }
        matrix
    };
    let facing = |a: usize| if a < count / 2 { count / 2..count } else { 0..count / 2 };
    let skip = Skip::new(
        "a panel's exchange with itself",
        "eq. (2) for all pairs of 200 facets; those in one plane give zero",
        "between the panels only",
    );
    skip.row(|| matrix(&|_| 0..count), || matrix(&facing))
}

/// Every entry of both blocks of the full matrix by itself, the exact way.
fn every_pair(n: usize) -> Vec<f64> {
    let wedge = Wedge::new(&fold(ANGLE_DEG, n));
    let row = |i: usize| i as f64..(i + 1) as f64;
    let mut block = vec![0.0; n.pow(4)];
    for from in 0..n * n {
        for to_row in 0..n {
            let entries = &mut block[(from * n + to_row) * n..][..n];
            let (left, right) = entries.split_at_mut(from % n);
            // To the facets on the right of this one, then to those on its left, from it outwards.
            wedge.exchange(&row(from / n), &row(to_row), right);
            let mut outwards = vec![0.0; left.len() + 1];
            wedge.exchange(&row(from / n), &row(to_row), &mut outwards);
            left.iter_mut().rev().zip(&outwards[1..]).for_each(|(entry, value)| *entry = *value);
        }
    }
    block
}

fn repeated_pairs(n: usize) -> String {
    let skip = Skip::new(
        format!("repeated pairs, {n}x{n}"),
        format!("each of the {} pairs, in both directions", n.pow(4)),
        format!("{} distinct entries: shift, mirror, reciprocity", n * n * (n + 1) / 2),
    );
    let both = || {
        // The other panel's block is the same work again.
        let back = std::hint::black_box(every_pair(n));
        drop(back);
        every_pair(n)
    };
    skip.row(both, || block(&form_factors(&fold(ANGLE_DEG, n))))
}
