//! All extremes at once, through the tools: every combination gives what a dense solver gives and an estimate
//! that is no more certain than it is right. Nothing but a sun that leaves a panel in the shade is refused,
//! in one line, and no sheet but one that is black or drowned in noise goes without an estimate.

use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::RngSeed;

use crate::common::{Ended, Workdir};
use crate::measured::{SPECTRA, tells_failures_alone};

/// Facets are off by no more than that share of the brightest.
const FACET_ERROR: f64 = 1e-9;
/// The root mean square of an estimate's errors in units of its standard deviations, with noise and without.
/// Spectra of no known class (all black, all white) are further from what was expected than Munsell chips,
/// two of three of which are within one; and where there is no noise it counts that tables of three digits
/// are rougher than any spectrum that was expected.
const HONEST: [f64; 2] = [6.0, 20.0];

/// Runs the four tools; prints what `corners.py` does.
fn through_the_tools(folder: &Workdir, kernel: &str, sheet: &str, noise_sd: f64) -> Ended {
    let python = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/extremes/corners.py");
    folder.sh(&format!(
        "vkernel {kernel} --mesh facets --tolerance 1e-9 --save kernel=K.npy -o scene.json
        vforward scene.json {sheet} --save facet_rgb=clean.npy -o clean
        vforward scene.json {sheet} --noise-sd {noise_sd} --seed 1 -o noisy
        vestimate -q noisy -o estimate || [ $? = 3 ]
        vscore estimate -o scores || [ $? = 3 ]
        ! grep -qi nan scores
        python3 -B {python} < scores"
    ))
}

fn refuses_the_shade(run: &Ended) -> bool {
    let says = run.stderr.starts_with("vkernel: ") && run.stderr.contains("in the shade");
    run.status == 2 && run.stderr.lines().count() == 1 && says
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 16,
        max_shrink_iters: 8,
        rng_seed: RngSeed::Fixed(0),
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_corner_is_right_or_refused(
        (angle, panel, facets) in (
            select(&[0.1, 1.0, 10.0, 45.0, 90.0, 150.0, 179.0, 179.9, 180.0][..]),
            select(&["1x1", "1000x1", "1x1000"][..]),
            select(&["1x1", "1x9", "9x1", "5x5", "16x16"][..]),
        ),
        (tilt, sky) in (select(&[0.0, 0.04, 20.0][..]), select(&["0", "0.3"][..])),
        (reflectance, camera, illuminant) in (
            select(&["0", "1e-6", "0.5", "0.999", "1", "cc24:red", "cc24:black", "munsell:5R6/12"][..]),
            select(&["grey.csv", "canon-5d-mark-ii", "twelve.csv"][..]),
            select(&["D65", "line.csv", "gap.csv", "FL11", "A --illuminant D65 --illuminant LCD-B"][..]),
        ),
        (noise, exposure) in (select(&[0.0, 1e-3, 0.1][..]), select(&[1e-6, 1.0, 1e3][..])),
    ) {
        let folder = Workdir::new();
        prop_assert_eq!(folder.sh(SPECTRA).stderr, "");
        let run = through_the_tools(
            &folder,
            &format!("--angle-deg {angle} --panel {panel} --facets {facets} --tilt-deg {tilt} --sky {sky}"),
            &format!("--reflectance {reflectance} --camera {camera} --illuminant {illuminant} \
                      --exposure {exposure}"),
            noise * exposure,
        );
        if tilt >= 0.5 * angle {
            prop_assert!(refuses_the_shade(&run), "{run:?}");
            return Ok(());
        }
        prop_assert!(run.status == 0 && tells_failures_alone(&run), "{run:?}");
        let numbers: Vec<f64> = run.stdout.split_whitespace().map(|text| text.parse().unwrap()).collect();
        prop_assert!(numbers[0] <= FACET_ERROR, "facets off by {}", numbers[0]);
        let honest = HONEST[usize::from(noise <= 0.0)];
        let may_lack_an_estimate = reflectance == "0" || noise > 0.0;
        prop_assert!(numbers.get(1).map_or(may_lack_an_estimate, |z| *z <= honest), "{numbers:?}");
    }
}
