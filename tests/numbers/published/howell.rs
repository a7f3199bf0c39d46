//! J. R. Howell, *A Catalog of Radiation Heat Transfer Configuration Factors*: closed forms of configurations
//! C-11, C-14 and C-16, and the catalogue's table of C-16 at 120° but for its last column, which is up to
//! 6e-6 off the catalogue's own closed form.

use std::f64::consts::PI;

use vfold::surfaces::Shape;
use vfold::surfaces::kernel::SurfaceKernel;
use vfold::surfaces::kernel::patches::{Division, patches};

use super::{assert_near, between_panels};

const SIDES: [f64; 4] = [0.2, 0.7, 1.0, 3.0];

fn sq(x: f64) -> f64 {
    x * x
}

/// C-11: equal rectangles face to face, sides x and y in units of their distance.
fn c11(x: f64, y: f64) -> f64 {
    let (rx, ry) = ((1.0 + sq(x)).sqrt(), (1.0 + sq(y)).sqrt());
    let logarithm = (rx * ry / (1.0 + sq(x) + sq(y)).sqrt()).ln();
    let arcs = x * ry * (x / ry).atan() + y * rx * (y / rx).atan() - x * x.atan() - y * y.atan();
    2.0 / (PI * x * y) * (logarithm + arcs)
}

/// C-14: rectangles at a right angle, depths w and h in units of the common edge, seen from the first.
fn c14(w: f64, h: f64) -> f64 {
    let (w2, h2) = (sq(w), sq(h));
    let far = (w2 + h2).sqrt();
    let arcs = w * (1.0 / w).atan() + h * (1.0 / h).atan() - far * (1.0 / far).atan();
    let all = 1.0 + w2 + h2;
    let logarithms = ((1.0 + w2) * (1.0 + h2) / all).ln()
        + w2 * (w2 * all / ((1.0 + w2) * (w2 + h2))).ln()
        + h2 * (h2 * all / ((1.0 + h2) * (h2 + w2))).ln();
    (arcs + 0.25 * logarithms) / (PI * w)
}

/// C-16: rectangles at the angle `phi`, depths b and a in units of the common edge, seen from the first.
fn c16(phi: f64, a: f64, b: f64) -> f64 {
    let (sin, cos) = phi.sin_cos();
    let (sin2, cos2) = (2.0 * phi).sin_cos();
    let (a2, b2) = (sq(a), sq(b));
    let c = a2 + b2 - 2.0 * a * b * cos;
    let d = (1.0 + a2 * sq(sin)).sqrt();
    let wedge = a * b * sin
        + (PI / 2.0 - phi) * (a2 + b2)
        + b2 * ((a - b * cos) / (b * sin)).atan()
        + a2 * ((b - a * cos) / (a * sin)).atan();
    let logarithms = (2.0 / sq(sin) - 1.0) * ((1.0 + a2) * (1.0 + b2) / (1.0 + c)).ln()
        + b2 * (b2 * (1.0 + c) / ((1.0 + b2) * c)).ln()
        + a2 * (a2 * (1.0 + a2).powf(cos2) / (c * (1.0 + c).powf(cos2))).ln();
    let arcs = b * (1.0 / b).atan() + a * (1.0 / a).atan() - c.sqrt() * (1.0 / c.sqrt()).atan();
    let across = a * d * ((a * cos / d).atan() + ((b - a * cos) / d).atan());
    let along = simpson(b, |x| {
        let far = (1.0 + sq(x * sin)).sqrt();
        far * ((x * cos / far).atan() + ((a - x * cos) / far).atan())
    });
    let terms =
        -sin2 / 4.0 * wedge + sq(sin) / 4.0 * logarithms + arcs + sin * sin2 / 2.0 * across + cos * along;
    terms / (PI * b)
}

/// ∫ f from 0 to `end`: the one integral that C-16 leaves.
fn simpson(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    const PANELS: usize = 2000;
    let step = end / (2 * PANELS) as f64;
    let weight = |k: usize| if k == 0 || k == 2 * PANELS { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 };
    step / 3.0 * (0..=2 * PANELS).map(|k| weight(k) * f(k as f64 * step)).sum::<f64>()
}

/// Two rectangles as a surface: `x` by `y` face to face a unit apart.
fn face_to_face(x: f64, y: f64) -> f64 {
    let corners = |z: f64| [[0.0, 0.0, z], [x, 0.0, z], [x, y, z], [0.0, y, z]];
    let vertices = [corners(0.0), corners(1.0)].concat();
    let shape = Shape::new(vertices, vec![vec![0, 1, 2, 3], vec![7, 6, 5, 4]], vec![]).unwrap().0;
    SurfaceKernel::new(&shape, &patches(&shape, Division::NONE), 1e-6).unwrap().matrix_row(0)[1]
}

/// Kernels of surfaces are kept in single precision.
#[test]
fn rectangles_face_to_face_have_the_factors_of_c_11() {
    assert_near(&[c11(1.0, 1.0)], &[0.199_824_895_698_387], 1e-15, "the formula, unit squares");
    for (x, y) in SIDES.iter().flat_map(|x| SIDES.map(|y| (*x, y))) {
        assert_near(&[face_to_face(x, y)], &[c11(x, y)], 1e-6, &format!("{x} x {y}"));
    }
}

#[test]
fn rectangles_at_right_angles_have_the_factors_of_c_14() {
    assert_near(&[c14(1.0, 1.0)], &[0.200_043_776_075_403], 1e-15, "the formula, squares");
    for (w, h) in SIDES.iter().flat_map(|w| SIDES.map(|h| (*w, h))) {
        assert_near(&[between_panels(90.0, 1.0, [w, h])], &[c14(w, h)], 1e-13, &format!("{w} and {h}"));
    }
}

#[test]
fn inclined_rectangles_have_the_factors_of_c_16() {
    for angle_deg in [15.0, 30.0, 45.0, 60.0, 100.0, 135.0, 165.0] {
        for (b, a) in SIDES.iter().flat_map(|b| SIDES.map(|a| (*b, a))) {
            let want = c16(f64::to_radians(angle_deg), a, b);
            let got = between_panels(angle_deg, 1.0, [b, a]);
            assert_near(&[got], &[want], 1e-11, &format!("{angle_deg}° {b} and {a}"));
        }
    }
}

/// Other panel's depth, columns of [`AT_120_DEG`].
const OTHER_DEPTHS: [f64; 4] = [0.05, 0.4, 1.0, 4.0];

/// Depth of the panel that is seen from, in units of the common edge, and form factors.
#[rustfmt::skip]
const AT_120_DEG: [(f64, [f64; 4]); 10] = [
    ( 0.1, [0.085852, 0.191745, 0.206687, 0.211149]),
    ( 0.2, [0.050029, 0.155990, 0.180050, 0.188211]),
    ( 0.4, [0.026983, 0.111512, 0.143284, 0.156919]),
    ( 0.6, [0.018400, 0.085512, 0.118331, 0.135469]),
    ( 1.0, [0.011209, 0.057314, 0.086615, 0.107099]),
    ( 2.0, [0.005650, 0.030691, 0.050404, 0.070897]),
    ( 4.0, [0.002831, 0.015692, 0.026775, 0.042260]),
    ( 6.0, [0.001888, 0.010510, 0.018105, 0.029927]),
    (10.0, [0.001133, 0.006322, 0.010950, 0.018752]),
    (20.0, [0.000567, 0.003164, 0.005495, 0.009608]),
];

/// Six decimals.
#[test]
fn folds_of_120_degrees_have_the_factors_of_the_table() {
    for (depth, factors) in AT_120_DEG {
        let got = OTHER_DEPTHS.map(|other| between_panels(120.0, 1.0, [depth, other]));
        assert_near(&got, &factors, 7e-7, &format!("depth {depth}"));
    }
}
