//! Decides whether the colours of a lattice are those of a chart.

use nalgebra::{Matrix3, SMatrix};

/// Columns and rows of patches.
pub(super) const COLUMNS: usize = 6;
pub(super) const ROWS: usize = 4;
pub(super) const PATCHES: usize = COLUMNS * ROWS;

/// Colours of patches, row by row.
pub(super) type Colours = [[f64; 3]; PATCHES];

/// The chart's 24 patches through one camera, relative to white: `share/cc24.csv` through
/// `share/canon-5d-mark-ii.csv` in D55, 400 to 700 nm. Other lights and cameras amount to little more than a
/// linear map.
#[rustfmt::skip]
#[allow(clippy::approx_constant)] // colours
pub(super) const REFERENCE: Colours = [
    [0.1304, 0.0790, 0.0589], [0.4455, 0.3160, 0.2588],
    [0.1598, 0.2198, 0.2995], [0.1156, 0.1241, 0.0707],
    [0.2497, 0.2722, 0.3927], [0.3180, 0.4869, 0.4468],
    [0.4482, 0.1881, 0.0670], [0.1004, 0.1536, 0.3050],
    [0.3481, 0.1305, 0.1262], [0.0860, 0.0657, 0.1175],
    [0.3967, 0.4009, 0.1529], [0.5605, 0.3120, 0.1040],
    [0.0482, 0.0923, 0.2378], [0.1649, 0.2419, 0.1153],
    [0.2686, 0.0647, 0.0526], [0.6909, 0.4815, 0.1508],
    [0.3363, 0.1581, 0.2517], [0.1196, 0.2766, 0.3721],
    [0.8864, 0.8861, 0.8789], [0.5838, 0.5825, 0.5820],
    [0.3575, 0.3577, 0.3581], [0.2027, 0.2028, 0.2031],
    [0.0918, 0.0929, 0.0937], [0.0332, 0.0338, 0.0348],
];

/// Fraction of the brightest patch added to a patch's light in its weight: darker light is mostly noise and
/// stray light.
const DARK: f64 = 0.03;

/// Departure of patches from the chart's, each relative to its own light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Departure {
    /// Root mean square over patches and channels.
    pub rms: f64,
    /// The largest over patches and channels.
    pub worst: f64,
}

/// Departure of the patches from the chart's under any light and camera: from the nearest linear map of the
/// chart's colours. None for a picture without light.
pub(super) fn departure(seen: &Colours) -> Option<Departure> {
    let light = |patch: &[f64; 3]| patch.iter().sum::<f64>() / 3.0;
    let brightest = seen.iter().map(light).fold(0.0, f64::max);
    if !(brightest > 0.0 && brightest.is_finite()) {
        return None;
    }
    let weights = seen.map(|patch| 1.0 / (light(&patch).max(0.0) + DARK * brightest));
    let weighed = |colours: &Colours| {
        SMatrix::<f64, 3, PATCHES>::from_fn(|channel, k| weights[k] * colours[k][channel])
    };
    let (reference, seen) = (weighed(&REFERENCE), weighed(seen));
    let map: Matrix3<f64> =
        seen * reference.transpose() * (reference * reference.transpose()).try_inverse()?;
    let off = seen - map * reference;
    let rms = (off.norm_squared() / off.len() as f64).sqrt();
    rms.is_finite().then(|| Departure { rms, worst: off.amax() })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a test stops at the first surprise

    use super::*;
    use crate::camera::CameraResponse;
    use crate::spectrum::{Outside, WavelengthGrid, camera, illuminant, reflectances};

    /// The chart through a built-in camera, normalised to 1 for white in each channel.
    fn seen(by: &str, light: &str) -> Colours {
        let grid = WavelengthGrid::uniform(400.0, 700.0, 5.0).unwrap();
        let sensitivities: Vec<_> = camera(by)
            .unwrap()
            .channels
            .iter()
            .map(|curve| curve.on(&grid, Outside::Zero).unwrap())
            .collect();
        let power = illuminant(light).unwrap().on(&grid, Outside::Refuse).unwrap();
        let response = CameraResponse::new(&grid, &sensitivities, &power).unwrap();
        let white = response.white();
        let patches = reflectances("cc24").unwrap();
        std::array::from_fn(|k| {
            let rgb = response.of_flat(&patches[k].on(&grid, Outside::Refuse).unwrap());
            [0, 1, 2].map(|channel| rgb[channel] / white[channel])
        })
    }

    #[test]
    fn the_reference_is_what_share_makes_of_it() {
        let seen = seen("canon-5d-mark-ii", "D55");
        for (seen, reference) in seen.iter().flatten().zip(REFERENCE.iter().flatten()) {
            assert!((seen - reference).abs() < 5e-4, "{seen} {reference}");
        }
    }

    #[test]
    fn other_cameras_and_lights_change_little_and_other_orders_much() {
        for (camera, light) in [("nikon-d5100", "A"), ("sigma-sd-merrill", "D75")] {
            let mut seen = seen(camera, light).map(|[r, g, b]| [0.3 * r, 0.6 * g, 0.2 * b]);
            let there = departure(&seen).unwrap();
            assert!(there.rms < 0.07 && there.worst < 0.25, "{camera} {light}: {there:?}");
            seen.reverse();
            assert!(departure(&seen).unwrap().rms > 0.4);
        }
    }
}
