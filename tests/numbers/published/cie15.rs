//! CIE 015:2018, *Colorimetry*, 4th edition: white points of its illuminants, as colour-science 0.4.7
//! transcribes them (`colour.TVS_ILLUMINANTS`, `colour.CCS_ILLUMINANTS`). The CIE sums over 380..780 nm by 5,
//! as [`meter`] does.

use vfold::colorimetry::Observer;

use super::{assert_near, chromaticity, meter};

/// XYZ for the 2° and the 10° observer, Y being 100.
#[rustfmt::skip]
const WHITE: [(&str, [f64; 3], [f64; 3]); 5] = [
    ("A",   [109.85, 100.00,  35.58], [111.14, 100.00,  35.20]),
    ("D50", [ 96.42, 100.00,  82.51], [ 96.72, 100.00,  81.43]),
    ("D55", [ 95.68, 100.00,  92.14], [ 95.80, 100.00,  90.93]),
    ("D65", [ 95.04, 100.00, 108.88], [ 94.81, 100.00, 107.32]),
    ("D75", [ 94.97, 100.00, 122.61], [ 94.42, 100.00, 120.64]),
];

/// x and y of fluorescent and LED lamps for the 2° observer.
#[rustfmt::skip]
const LAMPS: [(&str, [f64; 2]); 36] = [
    ("FL1", [0.3131, 0.3371]), ("FL2", [0.3721, 0.3751]), ("FL3", [0.4091, 0.3941]),
    ("FL4", [0.4402, 0.4031]), ("FL5", [0.3138, 0.3452]), ("FL6", [0.3779, 0.3882]),
    ("FL7", [0.3129, 0.3292]), ("FL8", [0.3458, 0.3586]), ("FL9", [0.3741, 0.3727]),
    ("FL10", [0.3458, 0.3588]), ("FL11", [0.3805, 0.3769]), ("FL12", [0.4370, 0.4042]),
    ("FL3.1", [0.4407, 0.4033]), ("FL3.2", [0.3808, 0.3734]), ("FL3.3", [0.3153, 0.3439]),
    ("FL3.4", [0.4429, 0.4043]), ("FL3.5", [0.3749, 0.3672]), ("FL3.6", [0.3488, 0.3600]),
    ("FL3.7", [0.4384, 0.4045]), ("FL3.8", [0.3820, 0.3832]), ("FL3.9", [0.3499, 0.3591]),
    ("FL3.10", [0.3455, 0.3560]), ("FL3.11", [0.3245, 0.3434]), ("FL3.12", [0.4377, 0.4037]),
    ("FL3.13", [0.3830, 0.3724]), ("FL3.14", [0.3447, 0.3609]), ("FL3.15", [0.3127, 0.3288]),
    ("LED-B1", [0.4560, 0.4078]), ("LED-B2", [0.4357, 0.4012]), ("LED-B3", [0.3756, 0.3723]),
    ("LED-B4", [0.3422, 0.3502]), ("LED-B5", [0.3118, 0.3236]), ("LED-BH1", [0.4474, 0.4066]),
    ("LED-RGB1", [0.4557, 0.4211]), ("LED-V1", [0.4548, 0.4044]), ("LED-V2", [0.3781, 0.3775]),
];

fn white(light: &str, observer: Observer) -> [f64; 3] {
    let (grid, meter) = meter(light, observer);
    meter.xyz(&vec![1.0; grid.len()])
}

/// The tables have two decimals.
#[test]
fn illuminants_have_the_tristimulus_values_of_the_table() {
    for (light, small, large) in WHITE {
        assert_near(&white(light, Observer::Cie1931_2deg), &small, 0.0101, light);
        assert_near(&white(light, Observer::Cie1964_10deg), &large, 0.0101, light);
    }
}

#[test]
fn lamps_have_the_chromaticity_of_the_tables() {
    for (lamp, want) in LAMPS {
        assert_near(&chromaticity(white(lamp, Observer::Cie1931_2deg)), &want, 1e-4, lamp);
    }
}

/// Section 4.1.2: daylight of the temperatures that these illuminants were named after, times 1.4388/1.4380
/// of Planck's constant.
#[test]
fn daylight_of_their_temperatures_has_their_tristimulus_values() {
    for (cct_k, (light, small, large)) in [5003, 5503, 6504, 7504].into_iter().zip(&WHITE[1..]) {
        let daylight = format!("daylight:{cct_k}");
        assert_near(&white(&daylight, Observer::Cie1931_2deg), small, 0.05, light);
        assert_near(&white(&daylight, Observer::Cie1964_10deg), large, 0.05, light);
    }
}
