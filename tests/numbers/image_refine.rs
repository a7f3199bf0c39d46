//! Corners that are off find back to where the renderer put them; where there is no edge they stay.

use std::path::Path;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal, Uniform};
use serde_json::Value;
use vfold::image::{
    Lens, LensEstimate, Marked, Photograph, Point, ReadOptions, Refinement, refine, write_linear,
};

use crate::common::is_there;

const PHOTOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos");
const MORE_PHOTOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/photos");

fn open(path: &Path) -> Photograph {
    Photograph::open(path, &ReadOptions::default()).unwrap()
}

/// The true corners of both panels.
fn corners(sidecar: &Value) -> [[Point; 4]; 2] {
    ["A", "B"].map(|panel| {
        ["crease_0", "crease_1", "outer_1", "outer_0"].map(|end| {
            let corner = &sidecar["panels_px"][panel][end];
            Point::new(corner[0].as_f64().unwrap(), corner[1].as_f64().unwrap())
        })
    })
}

fn distance(a: Point, b: Point) -> f64 {
    (a.x - b.x).hypot(a.y - b.y)
}

/// Every corner moved by so many px in a direction of its own; the two panels keep a common crease.
fn clicked(panels: &[[Point; 4]; 2], off_px: f64, seed: u64) -> [[Point; 4]; 2] {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let angles = Uniform::new(0.0, std::f64::consts::TAU).unwrap();
    let mut off = |p: Point| {
        let angle: f64 = angles.sample(&mut random);
        Point::new(p.x + off_px * angle.cos(), p.y + off_px * angle.sin())
    };
    let (panel0, outer) = (panels[0].map(&mut off), [panels[1][2], panels[1][3]].map(&mut off));
    [panel0, [panel0[0], panel0[1], outer[0], outer[1]]]
}

/// How far the worst corner is off, and the worst end of the crease, over some clicks.
fn worst(folder: &str, file: &str, clicks: u64) -> [f64; 2] {
    let path = Path::new(folder).join(file);
    let sidecar = serde_json::from_reader(std::fs::File::open(path.with_extension("json")).unwrap()).unwrap();
    let (photograph, truth) = (open(&path), corners(&sidecar));
    let mut worst = [0.0_f64; 2];
    for seed in 0..clicks {
        let found =
            refine(&photograph, &marked(&clicked(&truth, 4.0, seed)), &LensEstimate::UNKNOWN, 6.0).unwrap();
        for (panel, k) in (0..2).flat_map(|panel| (0..4).map(move |k| (panel, k))) {
            let off = distance(found.panels[panel][k], truth[panel][k]);
            worst[usize::from(k < 2)] = worst[usize::from(k < 2)].max(off);
        }
    }
    println!("{file}: outer corners within {:.3} px, crease ends within {:.3} px", worst[0], worst[1]);
    worst
}

#[test]
fn corners_four_pixels_off_find_back() {
    let [outer, crease] = worst(PHOTOS, "a_ideal_magenta_50.exr", 4);
    assert!(outer < 0.05 && crease < 0.1);
    if !is_there(MORE_PHOTOS) {
        return;
    }
    for file in [
        "b_noise_yellow_40.tif",
        "c_noise_foliage_45.png",
        "d_tilt6_sky20_orange_yellow_55.exr",
        "e_chart_purple_45.tif",
        "g_card_dark_skin_45.exr",
    ] {
        let [outer, crease] = worst(MORE_PHOTOS, file, 4);
        assert!(outer < 0.05 && crease < 0.15, "{file}");
    }
}

/// A grey picture of 200 x 200 px of light, refined from a quadrilateral in its middle.
fn refined(light: impl Fn(f64, f64) -> f64) -> (Refinement, [Point; 4]) {
    refined_in_colour(&LensEstimate::UNKNOWN, |x, y| [light(x, y); 3])
}

/// The same of a picture in colour.
fn refined_in_colour(lens: &LensEstimate, light: impl Fn(f64, f64) -> [f64; 3]) -> (Refinement, [Point; 4]) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("light.exr");
    let rgb: Vec<f64> =
        (0..200 * 200).flat_map(|k| light(f64::from(k % 200) + 0.5, f64::from(k / 200) + 0.5)).collect();
    write_linear(&path, 200, 200, &rgb).unwrap();
    let given = [(50.3, 40.2), (150.1, 45.0), (160.7, 150.4), (42.0, 155.5)].map(|(x, y)| Point::new(x, y));
    (refine(&open(&path), &marked(&[given]), lens, 6.0).unwrap(), given)
}

#[test]
fn where_there_is_no_edge_corners_stay() {
    let noise: Vec<f64> = {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        (0..40_000).map(|_| StandardNormal.sample(&mut random)).collect()
    };
    let noise = |x: f64, y: f64| noise[y as usize * 200 + x as usize];
    let flat = refined(|_, _| 0.5);
    let noisy = refined(|x, y| 0.5 + 0.01 * noise(x, y));
    let gradient = refined(|x, y| 0.2 + 0.002 * x + 1e-5 * x * y + 0.002 * noise(x, y));
    let vignette = refined(|x, y| 0.9 - 2e-5 * ((x - 90.0).powi(2) + (y - 110.0).powi(2)));
    for (found, given) in [flat, noisy, gradient, vignette] {
        assert_eq!(found.sides_without_edge.len(), 4, "{found:?}");
        assert!(found.moved_px[0].iter().all(|moved| *moved < 1e-9), "{found:?}");
        assert!(found.panels[0].iter().zip(&given).all(|(a, b)| distance(*a, *b) < 1e-9));
    }
}

/// A sheet as bright as the table that it lies on, of another colour; all corners are a little off.
#[test]
fn an_edge_between_colours_that_are_equally_bright_is_found() {
    let corners = [(48.0, 42.5), (152.0, 43.0), (158.0, 152.0), (44.0, 153.0)].map(|(x, y)| Point::new(x, y));
    let is_sheet = |x: f64, y: f64| {
        (0..4).all(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            (b.x - a.x) * (y - a.y) > (b.y - a.y) * (x - a.x)
        })
    };
    let light = |x, y| if is_sheet(x, y) { [0.5, 0.3, 0.1] } else { [0.2, 0.3, 0.4] };
    // pixels of this picture are of one colour or the other: half a pixel is as near as they tell, so that
    // sides may look bent, which no lens did
    let (found, _) = refined_in_colour(&LensEstimate::stated(Lens::STRAIGHT), light);
    for (found, truth) in found.panels[0].iter().zip(corners) {
        assert!(distance(*found, truth) < 0.6, "{found:?} {truth:?}");
    }
}

/// A lens bends all sides of a sheet. The side opposite the crease shows by how much, so that corners are
/// where the curves meet; a stated lens is believed.
#[test]
fn the_bend_of_the_outer_side_shows_the_lens() {
    let flat = [(30.0, 22.0), (168.0, 30.0), (172.0, 181.0), (25.0, 176.0)].map(|(x, y)| Point::new(x, y));
    for k1 in [-0.035, -0.01, 0.02] {
        let lens = Lens::new([k1, 0.0], 200, 200).unwrap();
        // a sheet in each of 5 x 5 parts of a pixel
        let is_sheet = |x: f64, y: f64| {
            let p = lens.undistort(Point::new(x, y));
            (0..4).all(|k| {
                let (a, b) = (flat[k], flat[(k + 1) % 4]);
                (b.x - a.x) * (p.y - a.y) > (b.y - a.y) * (p.x - a.x)
            })
        };
        let share = |x: f64, y: f64| {
            let parts = (0..25)
                .filter(|k| is_sheet(x - 0.4 + 0.2 * f64::from(k % 5), y - 0.4 + 0.2 * f64::from(k / 5)));
            parts.count() as f64 / 25.0
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bent.exr");
        let rgb: Vec<f64> = (0..200 * 200)
            .flat_map(|k| [0.1 + 0.5 * share(f64::from(k % 200) + 0.5, f64::from(k / 200) + 0.5); 3])
            .collect();
        write_linear(&path, 200, 200, &rgb).unwrap();
        let truth = flat.map(|corner| lens.distort(corner));
        let given = marked(&[truth.map(|p| Point::new(p.x + 1.5, p.y - 1.0))]);
        let off = |known: &LensEstimate| {
            let found = refine(&open(&path), &given, known, 6.0).unwrap();
            let off = found.panels[0].iter().zip(truth).map(|(found, truth)| distance(*found, truth));
            (off.fold(0.0, f64::max), found.lens)
        };
        let (off_px, found) = off(&LensEstimate::UNKNOWN);
        let error = found.lens.coefficients()[0] - k1;
        assert!(error.abs() < 0.004 && error.abs() < 3.0 * found.k1_sd, "{k1}: {found:?}");
        let (straight_px, stated) = off(&LensEstimate::stated(Lens::STRAIGHT));
        assert_eq!(stated, LensEstimate::stated(Lens::STRAIGHT));
        println!(
            "k1 {k1}: corners {off_px:.3} px off, through a straight lens {straight_px:.3} px, {found:?}"
        );
        // the bend of one side leaves a sixth of what was unknown of the lens; pixels add a tenth of one
        assert!(off_px < straight_px / 6.0 + 0.1, "{k1}: {off_px} {straight_px}");
    }
}

/// Behind a side the sheet's shadow falls on the table and ends a few pixels further out, where the step is
/// greater: the side stays at the end of the sheet.
#[test]
fn the_end_of_a_shadow_is_not_the_end_of_the_sheet() {
    let beyond = |x: f64, y: f64| (x - 153.0) * 105.4 / 105.9 - (y - 45.0) * 10.6 / 105.9;
    let (found, _) = refined_in_colour(&LensEstimate::UNKNOWN, |x, y| match beyond(x, y) {
        outside if outside > 4.0 => [0.5, 0.5, 0.5],
        outside if outside > 0.0 => [0.02, 0.02, 0.02],
        _ => [0.4, 0.2, 0.1],
    });
    let [moved, outer] = [found.moved_px[0][1], found.moved_px[0][2]];
    assert!((moved - 2.9).abs() < 0.4 && (outer - 2.9).abs() < 0.4, "{found:?}");
}

/// One side has an edge, 3 px off: its two corners follow it, along the other sides nothing is known.
#[test]
fn a_side_without_edge_stays_while_others_move() {
    let (found, _) = refined(|x, y| 0.1 + 0.4 * f64::from(x > 153.1 + (y - 45.0) * 10.6 / 105.4));
    assert_eq!(found.sides_without_edge, ["crease", "outer side of panel 0", "end 0 of panel 0"]);
    let across = 3.0 * 105.4 / f64::hypot(10.6, 105.4);
    for (moved, want) in found.moved_px[0].iter().zip([0.0, across, across, 0.0]) {
        assert!((moved - want).abs() < 0.15, "{found:?}");
    }
}

#[test]
fn panels_that_share_no_crease_are_refused() {
    let panel =
        |x: f64| [(x, 10.0), (x, 90.0), (x + 40.0, 90.0), (x + 40.0, 10.0)].map(|(x, y)| Point::new(x, y));
    let photograph = open(&Path::new(PHOTOS).join("a_ideal_magenta_50.exr"));
    let error =
        refine(&photograph, &marked(&[panel(10.0), panel(100.0)]), &LensEstimate::UNKNOWN, 6.0).unwrap_err();
    assert_eq!(error.exit_status(), 2, "{error}");
}

/// One panel, or two that share their crease.
fn marked(panels: &[[Point; 4]]) -> Vec<Marked> {
    let joints = [[0, 1, 2, 3], [0, 1, 4, 5]];
    let marked = |(panel, (corners, joints)): (usize, (&[Point; 4], [usize; 4]))| Marked {
        panel,
        corners: *corners,
        joints,
    };
    panels.iter().zip(joints).enumerate().map(marked).collect()
}
