//! The angle of a fold from its six corners: folds seen by a pinhole are found again.

use nalgebra::Vector3;
use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use vfold::forward::render::{Frame, Pinhole, Stand};
use vfold::geometry::{FacetGrid, Fold};
use vfold::image::{CornersBy, FoldAngle, FoldSeen, Lens, LensEstimate, Point};

/// Diagonal of a picture on film, mm.
const FILM_DIAGONAL_MM: f64 = 43.27;
const SIZE: [usize; 2] = [4000, 3000];

/// A fold and where its camera stands.
#[derive(Debug, Clone, Copy)]
struct Scene {
    angle_deg: f64,
    depths: [f64; 2],
    /// Towards the camera: about the crease and across it, radians; and its roll.
    turns: [f64; 3],
    /// As on film, mm.
    focal_mm: f64,
    k1: f64,
}

impl Scene {
    fn diagonal_px() -> f64 {
        (SIZE[0] as f64).hypot(SIZE[1] as f64)
    }

    /// Its corners, px; none if a panel is seen from behind or edge on.
    fn corners(&self) -> Option<[[Point; 4]; 2]> {
        let one = FacetGrid { rows: 1, cols: 1 };
        let fold = Fold::new(self.angle_deg, 1.0, self.depths[0], one).unwrap();
        let fold = fold.with_panel1_depth(self.depths[1]).unwrap();
        let [about, across, roll] = self.turns;
        let focal_px = self.focal_mm / FILM_DIAGONAL_MM * Self::diagonal_px();
        let distance = focal_px / (SIZE[1] as f64 / 2.0) * self.depths[0].max(1.0) * 1.2;
        let towards = Vector3::new(about.sin() * across.cos(), across.sin(), about.cos() * across.cos());
        let look_at = Vector3::new(0.1, -0.1, self.depths[0] / 3.0);
        let up = Vector3::new(roll.sin(), roll.cos(), 0.0);
        let stand = Stand { eye: look_at + distance * towards, look_at, up };
        let field_deg = 2.0 * (SIZE[0] as f64 / 2.0 / focal_px).atan().to_degrees();
        let camera =
            Pinhole::with_field_of_view(&stand, field_deg, Frame::new(SIZE[0], SIZE[1]).unwrap()).unwrap();
        let lens = Lens::new([self.k1, 0.0], SIZE[0], SIZE[1]).unwrap();
        let seen = fold.panels().map(|panel| panel.corners.map(|p| lens.distort(camera.project(p).unwrap())));
        let areas = [-signed_area(&seen[0]), signed_area(&seen[1])];
        let is_open = areas[0].min(areas[1]) > 0.1 * areas[0].max(areas[1]);
        is_open.then_some(seen)
    }

    fn seen(&self) -> FoldSeen {
        FoldSeen {
            size: SIZE,
            corners_by: CornersBy::Finding,
            lens: LensEstimate::UNKNOWN,
            focal_35mm: Some(self.focal_mm),
            depths: None,
        }
    }
}

/// Area of a quadrilateral, px², positive if it runs clockwise as seen.
fn signed_area([a, b, c, d]: &[Point; 4]) -> f64 {
    ((a.x - c.x) * (b.y - d.y) - (a.y - c.y) * (b.x - d.x)) / 2.0
}

fn has_depths(found: &FoldAngle, depths: [f64; 2]) -> bool {
    found.depths.iter().zip(depths).all(|(found, depth)| (found - depth).abs() < 1e-9)
}

const UPRIGHT: Scene =
    Scene { angle_deg: 50.0, depths: [1.0; 2], turns: [0.1, 0.5, 0.0], focal_mm: 50.0, k1: 0.0 };

proptest! {
    #[test]
    fn a_fold_of_known_form_is_found_as_it_is(
        angle_deg in 20.0..120.0,
        depths in prop::array::uniform2(0.4..2.0),
        turns in (-0.3..0.3, -0.7..0.7, -3.0..3.0),
        focal_mm in 24.0..150.0,
    ) {
        let scene = Scene { angle_deg, depths, turns: turns.into(), focal_mm, k1: 0.0 };
        let Some(corners) = scene.corners() else { return Ok(()) };
        let found = FoldSeen { depths: Some(depths), ..scene.seen() }.angle(&corners).unwrap();
        prop_assert!((found.angle_deg - angle_deg).abs() < 0.05, "{found:?}");
        prop_assert!(found.angle_sd_deg < 3.0, "{found:?}");
        prop_assert!(has_depths(&found, depths), "{found:?}");
    }

    /// Panels and ends may be counted from either side.
    #[test]
    fn whatever_corners_are_called_the_angle_is_one(angle_deg in 30.0..90.0, across in 0.2..0.7) {
        let scene = Scene { angle_deg, turns: [0.1, across, 0.3], depths: [1.0, 0.8], ..UPRIGHT };
        let panels = scene.corners().unwrap();
        let from_the_other_end = panels.map(|[a, b, c, d]| [b, a, d, c]);
        for (corners, depths) in [
            (panels, scene.depths),
            ([panels[1], panels[0]], [0.8, 1.0]),
            (from_the_other_end, scene.depths),
        ] {
            let found = FoldSeen { depths: Some(depths), ..scene.seen() }.angle(&corners).unwrap();
            prop_assert!((found.angle_deg - angle_deg).abs() < 0.05, "{found:?}");
            prop_assert!(has_depths(&found, depths), "{found:?}");
        }
    }
}

#[test]
fn the_form_of_the_panels_is_found() {
    let a4_folded = [0.5_f64.sqrt(), 0.125_f64.sqrt()];
    for depth in a4_folded.into_iter().chain([1.0, 5.5 / 8.5, 1.25]) {
        let scene = Scene { depths: [depth; 2], turns: [0.15, 0.6, 0.0], focal_mm: 28.0, ..UPRIGHT };
        let found = scene.seen().angle(&scene.corners().unwrap()).unwrap();
        assert!((found.angle_deg - 50.0).abs() < 0.5, "{depth}: {found:?}");
        assert!(found.depths.iter().all(|found| (found / depth - 1.0).abs() < 0.02), "{depth}: {found:?}");
    }
}

/// Folds as they are believed to be, with corners off as they are believed to be.
#[test]
fn standard_deviations_hold() {
    let mut draws = ChaCha8Rng::seed_from_u64(7);
    let mut normal = |sd: f64| -> f64 {
        let draw: f64 = StandardNormal.sample(&mut draws);
        sd * draw
    };
    let mut off = Vec::new();
    while off.len() < 200 {
        let scene = Scene {
            angle_deg: 60.0 + normal(12.0),
            turns: [normal(0.2), normal(0.35), normal(1.0)],
            focal_mm: 55.0 * normal(0.5).exp(),
            k1: normal(0.02).clamp(-0.04, 0.04),
            ..UPRIGHT
        };
        let Some(corners) = scene.corners() else { continue };
        let mean_area = corners.iter().map(|panel| signed_area(panel).abs()).sum::<f64>() / 2.0;
        let sd_px = 0.002 * mean_area.sqrt();
        let mut moved = |p: Point| Point::new(p.x + normal(sd_px), p.y + normal(sd_px));
        let [left, mut right] = corners.map(|panel| panel.map(&mut moved));
        // the ends of the crease are those of both panels
        (right[0], right[1]) = (left[0], left[1]);
        let found = FoldSeen { focal_35mm: None, ..scene.seen() }.angle(&[left, right]).unwrap();
        off.push((found.angle_deg - scene.angle_deg) / found.angle_sd_deg);
    }
    let within_2 = off.iter().filter(|off| off.abs() < 2.0).count() as f64 / off.len() as f64;
    let mean_square = off.iter().map(|off| off * off).sum::<f64>() / off.len() as f64;
    assert!(within_2 > 0.93 && (0.15..1.5).contains(&mean_square), "{within_2} {mean_square}");
}

#[test]
fn corners_of_no_fold_tell_nothing_or_little() {
    let [left, right] = UPRIGHT.corners().unwrap();
    let seen = UPRIGHT.seen();
    assert_eq!(seen.angle(&[left, left]), None);
    let mut off = right;
    off[2] = Point::new(off[2].x + 300.0, off[2].y - 200.0);
    let sure = seen.angle(&[left, right]).unwrap().angle_sd_deg;
    assert!(seen.angle(&[left, off]).is_none_or(|found| found.angle_sd_deg > 5.0 * sure));
}

/// A picture whose camera wrote its focal length and that was cropped afterwards.
#[test]
fn a_wrong_focal_length_does_no_harm() {
    let corners = UPRIGHT.corners().unwrap();
    let cropped = FoldSeen { focal_35mm: Some(UPRIGHT.focal_mm / 2.5), ..UPRIGHT.seen() };
    let found = cropped.angle(&corners).unwrap();
    assert!((found.angle_deg - 50.0).abs() < 1.0, "{found:?}");
    assert!(has_depths(&found, [1.0; 2]), "{found:?}");
}
