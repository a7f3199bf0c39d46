//! R. V. Dunkle, "Geometric mean beam lengths for radiant heat-transfer calculations", *Journal of Heat
//! Transfer* 86 (1964), p. 75, as table A-2 of Howell, Mengüç, Daun and Siegel, *Thermal Radiation Heat
//! Transfer*, web appendix: rectangles at right angles.

use super::{assert_near, between_panels};

/// Other panel's depth in units of the common edge.
const DEPTHS: [f64; 11] = [0.05, 0.1, 0.2, 0.4, 0.6, 1.0, 2.0, 4.0, 6.0, 10.0, 20.0];

/// One panel's depth in the same unit, and area times form factor from where the two are equally deep.
const EXCHANGES: [(f64, &[f64]); 7] = [
    (
        0.05,
        &[
            0.014269, 0.018601, 0.02117, 0.02243, 0.02279, 0.02304, 0.02316, 0.02320, 0.02321, 0.02321,
            0.02321,
        ],
    ),
    (0.1, &[0.02819, 0.03622, 0.04086, 0.04229, 0.04325, 0.04376, 0.04390, 0.04393, 0.04394, 0.04394]),
    (0.2, &[0.05421, 0.06859, 0.07377, 0.07744, 0.07942, 0.07999, 0.08010, 0.08015, 0.08018]),
    (0.4, &[0.10013, 0.11524, 0.12770, 0.13514, 0.13736, 0.13779, 0.13801, 0.13811]),
    (0.6, &[0.13888, 0.16138, 0.17657, 0.18143, 0.18239, 0.18289, 0.18311]),
    (1.0, &[0.20004, 0.23285, 0.24522, 0.24783, 0.24921, 0.24980]),
    (2.0, &[0.29860, 0.33462, 0.34386, 0.34916, 0.35142]),
];

/// Entries that are misprinted: closed form C-14 and reference values with 60 digits have 0.01437 and
/// 0.34910.
const MISPRINTS: [[f64; 2]; 2] = [[0.05, 0.05], [2.0, 10.0]];

/// Five decimals.
#[test]
fn rectangles_at_right_angles_exchange_what_table_a_2_has() {
    for (depth, exchanges) in EXCHANGES {
        for (other, want) in DEPTHS.into_iter().filter(|other| *other >= depth).zip(exchanges) {
            if !MISPRINTS.contains(&[depth, other]) {
                let got = depth * between_panels(90.0, 1.0, [depth, other]);
                assert_near(&[got], &[*want], 6e-6, &format!("{depth} and {other}"));
            }
        }
    }
}
