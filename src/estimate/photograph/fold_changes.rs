//! How the departure of a sheet from a Lambertian one changes with the shape of the fold and the place of
//! the sun.

use std::sync::LazyLock;

use nalgebra::DMatrix;

use super::chebyshev::{NODES, nodes};
use super::conditions::Conditions;
use super::parts::{Parts, Radiance};
use super::sheets::{CHANGES, CREASE_RADII, Departure};
use crate::sheet::POWERS;
use crate::solve::dense::{add, columns};

/// Additional radiance of a sheet under these conditions.
pub(super) fn departed(parts: &Parts, conditions: &Conditions, departure: &Departure) -> Radiance {
    /// Powers of the albedo at the nodes: power by node.
    static AT_NODES: LazyLock<DMatrix<f64>> = LazyLock::new(|| {
        let nodes = nodes();
        DMatrix::from_fn(POWERS, NODES, |power, node| nodes[node].powi(power as i32))
    });
    let mut radiance = departure.radiance.clone();
    let Some(of_amounts) = &departure.changes else { return radiance };
    let [amounts_0, amounts_1] = [0, 1].map(|panel| amounts(parts, conditions, panel));
    // the facets of panel 0 come first
    let facets = parts.places.len();
    let of_panel_0 = parts.places.partition_point(|place| place.panel == 0);
    let mut changes = DMatrix::zeros(facets, POWERS);
    for (n, own) in columns(of_amounts).enumerate() {
        let (change, power) = (n / POWERS, n % POWERS);
        let sum = &mut changes.as_mut_slice()[power * facets..(power + 1) * facets];
        add(&mut sum[..of_panel_0], amounts_0[change], &own[..of_panel_0]);
        add(&mut sum[of_panel_0..], amounts_1[change], &own[of_panel_0..]);
    }
    radiance.gemm(1.0, &changes, &AT_NODES, 1.0);
    radiance
}

/// Amount of each change on a panel. A rounding counts only as far as it is tabulated.
fn amounts(parts: &Parts, conditions: &Conditions, panel: usize) -> [f64; CHANGES] {
    let [small, large] = CREASE_RADII;
    let radius = conditions.crease_radius.clamp(0.0, large);
    let part = radius / (large - small);
    let own = if panel == 0 { conditions.bow_difference_deg } else { -conditions.bow_difference_deg };
    [
        part * (large - radius) / small,
        part * (radius - small) / large,
        conditions.bow_deg + own,
        conditions.tilt_deg - parts.stated.tilt_deg,
    ]
}
