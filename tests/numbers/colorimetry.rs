//! Colour against colour-science and NumPy; published numbers are in `tests/numbers/published`.

use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use vfold::colorimetry::{Colorimeter, Colour, ErrorBars, Observer};
use vfold::spectrum::{Outside, WavelengthGrid, illuminant, reflectances};

/// CIELAB of the patches on 400..700 nm by 5 (D65, 10°), and CIEDE2000 to 0.9 r + 0.02: NumPy for the
/// trapezoid rule, colour-science 0.4.7 for the tables, `XYZ_to_Lab` and `delta_E`.
const CC24: [([f64; 3], f64); 24] = [
    ([36.773152, 13.896395, 14.572348], 2.610982),
    ([65.791920, 13.414130, 17.689984], 1.336949),
    ([51.619270, -3.780426, -20.235482], 0.984075),
    ([42.052834, -12.326845, 21.785359], 2.295565),
    ([57.455905, 6.641895, -23.202307], 1.010548),
    ([71.706779, -30.200917, 3.623934], 1.547057),
    ([59.544272, 33.787817, 54.915922], 2.477672),
    ([42.719171, 7.564208, -39.160144], 1.612080),
    ([50.452158, 42.444508, 13.929035], 1.469643),
    ([31.235101, 20.184379, -22.439253], 3.293022),
    ([70.658613, -19.704383, 58.010486], 2.063395),
    ([69.927474, 20.190823, 63.993237], 2.248711),
    ([32.582036, 13.345868, -46.700338], 2.691181),
    ([54.815992, -34.125394, 34.881509], 1.877000),
    ([40.217840, 48.515833, 24.289291], 2.711797),
    ([79.917619, 4.366339, 79.324465], 2.307410),
    ([51.319605, 42.845448, -15.630152], 1.389236),
    ([53.440858, -30.210194, -22.130603], 1.445670),
    ([95.455341, -0.439181, 0.934017], 1.785052),
    ([80.943760, 0.185867, 0.108297], 1.505751),
    ([66.376155, 0.111610, -0.105830], 1.002747),
    ([52.178400, 0.104403, -0.104636], 0.038266),
    ([36.487466, -0.151945, -0.482578], 1.662174),
    ([21.438237, -0.083986, -0.946868], 3.894215),
];

/// sRGB for the 2° observer: colour-science 0.4.7, Bradford adaptation to D65, `XYZ_to_sRGB`; cyan is out of
/// gamut.
const SRGB: [(&str, &str, [f64; 3]); 8] = [
    ("D65", "cc24:red", [0.697624, 0.185229, 0.226743]),
    ("D65", "cc24:foliage", [0.339097, 0.421481, 0.247585]),
    ("D65", "cc24:neutral-5", [0.488147, 0.487845, 0.488584]),
    ("D65", "cc24:cyan", [0.000000, 0.535840, 0.654637]),
    ("A", "cc24:red", [0.790077, 0.149687, 0.236346]),
    ("A", "cc24:foliage", [0.321814, 0.419071, 0.247858]),
    ("A", "cc24:neutral-5", [0.486996, 0.488300, 0.488391]),
    ("A", "cc24:cyan", [0.000000, 0.504703, 0.671273]),
];

fn assert_near(got: &[f64], want: &[f64], tolerance: f64, what: &str) {
    for (g, w) in got.iter().zip(want) {
        assert!((g - w).abs() < tolerance, "{what}: {got:?} for {want:?}");
    }
}

#[test]
fn patches_have_the_lab_of_colour_science() {
    let grid = WavelengthGrid::default();
    let d65 = Colorimeter::new(&grid, &illuminant("D65").unwrap(), Observer::Cie1964_10deg).unwrap();
    for (patch, (lab, difference)) in reflectances("cc24").unwrap().iter().zip(CC24) {
        let r = patch.on(&grid, Outside::Refuse).unwrap();
        let paler: Vec<f64> = r.iter().map(|r| 0.9 * r + 0.02).collect();
        assert_near(&d65.lab(&r), &lab, 2e-6, patch.name());
        assert_near(&[d65.delta_e_2000(&r, &paler)], &[difference], 2e-6, patch.name());
    }
}

#[test]
fn swatches_are_the_srgb_of_colour_science() {
    let grid = WavelengthGrid::default();
    for (light, patch, want) in SRGB {
        let meter = Colorimeter::new(&grid, &illuminant(light).unwrap(), Observer::Cie1931_2deg).unwrap();
        let r = reflectances(patch).unwrap()[0].on(&grid, Outside::Refuse).unwrap();
        assert_near(&meter.srgb(&r), &want, 1e-3, &format!("{patch} under {light}"));
    }
}

/// From D65 to A and to FL11 between a patch and half of it mixed with another: NumPy for the trapezoid rule
/// and the correction, colour-science 0.4.7 for tables, `XYZ_to_Lab` and `delta_E`.
#[rustfmt::skip]
const METAMERISM: [(&str, &str, [f64; 2]); 3] = [
    ("cc24:red", "cc24:orange", [2.4941191873105497, 1.1576279587490024]),
    ("cc24:green", "cc24:foliage", [1.0193763297438634, 0.2183652480226629]),
    ("cc24:blue-sky", "cc24:neutral-5", [2.933480072722106, 1.098697075584154]),
];

fn meter(light: &str) -> Colorimeter {
    Colorimeter::new(&WavelengthGrid::default(), &illuminant(light).unwrap(), Observer::Cie1964_10deg)
        .unwrap()
}

fn patch(name: &str) -> Vec<f64> {
    reflectances(name).unwrap()[0].on(&WavelengthGrid::default(), Outside::Refuse).unwrap()
}

#[test]
fn metamerism_is_that_of_numpy_and_colour_science() {
    let (d65, others) = (meter("D65"), ["A", "FL11"].map(meter));
    for (one, other, want) in METAMERISM {
        let (a, b) = (patch(one), patch(other));
        let mixed: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 0.5 * (a + b)).collect();
        let got = others.each_ref().map(|light| light.metamerism_index(&d65, &a, &mixed));
        assert_near(&got, &want, 2e-6, one);
        assert!(d65.metamerism_index(&d65, &a, &mixed) < 1e-9, "no change of light, no index");
        assert!(others[0].metamerism_index(&d65, &a, &a) < 1e-9);
    }
}

/// Draws of reflectances with neighbouring wavebands off together, an independent way to the spread of their
/// colours.
#[test]
fn error_bars_of_colours_are_those_of_a_simulation() {
    const DRAWS: usize = 20_000;
    let (d65, reflectance) = (meter("D65"), patch("cc24:orange"));
    let bands = reflectance.len();
    let covariance =
        DMatrix::from_fn(bands, bands, |i, j| 0.004_f64.powi(2) * (-0.1 * i.abs_diff(j) as f64).exp());
    let root = covariance.clone().cholesky().unwrap().l();
    let mut noise = ChaCha8Rng::seed_from_u64(1);
    let draw = |_| {
        let normal = DVector::from_fn(bands, |_, _| StandardNormal.sample(&mut noise));
        let off: DVector<f64> = &root * normal;
        numbers(&d65.colour(&reflectance.iter().zip(&off).map(|(r, off)| r + off).collect::<Vec<_>>()))
    };
    let draws: Vec<[f64; 9]> = (0..DRAWS).map(draw).collect();
    let rows: Vec<Vec<f64>> = covariance.row_iter().map(|row| row.iter().copied().collect()).collect();
    let sd = numbers(&d65.colour_sd(&reflectance, ErrorBars::Covariance(&rows)));
    let most = numbers(&d65.colour_sd(&reflectance, ErrorBars::Deviations(&vec![0.004; bands])));
    for (k, (sd, most)) in sd.into_iter().zip(most).enumerate() {
        let mean = draws.iter().map(|one| one[k]).sum::<f64>() / DRAWS as f64;
        let variance = draws.iter().map(|one| (one[k] - mean).powi(2)).sum::<f64>() / DRAWS as f64;
        assert!((sd / variance.sqrt() - 1.0).abs() < 0.02, "{k}: {sd} for {}", variance.sqrt());
        assert!(sd <= most, "{k}: {sd} is more than {most}");
    }
}

fn numbers(Colour { xyz, lab, srgb }: &Colour) -> [f64; 9] {
    let mut all = [0.0; 9];
    all.iter_mut().zip(xyz.iter().chain(lab).chain(srgb)).for_each(|(to, from)| *to = *from);
    all
}

#[test]
fn the_perfect_diffuser_is_white_under_every_light() {
    let grid = WavelengthGrid::default();
    for light in ["A", "D50", "FL11", "LED-RGB1", "daylight:25000", "1"] {
        for observer in [Observer::Cie1931_2deg, Observer::Cie1964_10deg] {
            let meter = Colorimeter::new(&grid, &illuminant(light).unwrap(), observer).unwrap();
            let white = vec![1.0; grid.len()];
            assert_near(&meter.xyz(&white)[1..2], &[100.0], 1e-9, light);
            assert_near(&meter.lab(&white), &[100.0, 0.0, 0.0], 1e-9, light);
            assert_near(&meter.srgb(&white), &[1.0; 3], 1e-3, light);
            assert_near(&meter.lab(&vec![0.0; grid.len()]), &[0.0; 3], 1e-9, light);
        }
    }
}

#[test]
fn a_light_without_blue_has_no_white() {
    let red = WavelengthGrid::uniform(680.0, 700.0, 5.0).unwrap();
    let failure = Colorimeter::new(&red, &illuminant("E").unwrap(), Observer::Cie1964_10deg).unwrap_err();
    assert!(failure.to_string().contains("choose another illuminant or grid"), "{failure}");
}
