//! Surfaces whose facets hide each other, against irradiances found by random walks, closed forms, and the
//! fold's own formulas.
//!
//! `tests/data/shapes` has the surfaces with what random walks, two million per facet, found on them.

use std::f64::consts::PI;
use std::path::Path;

use proptest::prelude::*;
use serde_json::Value;
use vfold::geometry::{FacetGrid, Fold, LightSource, Vec3};
use vfold::kernel::mesh::Mesh;
use vfold::paper::{Method, form_factors, respond};
use vfold::response::ModeLight;
use vfold::surfaces::kernel::patches::{Division, patches};
use vfold::surfaces::kernel::refinement::{Solved, solve};
use vfold::surfaces::kernel::sunlight::sunlight;
use vfold::surfaces::kernel::{Census, SurfaceKernel};
use vfold::surfaces::{Accordion, Polygon, Shape, SurfaceResponse, obj};

fn shape(name: &str) -> Shape {
    obj::read(&Path::new("tests/data/shapes").join(format!("{name}.obj"))).unwrap().0
}

fn kernel(shape: &Shape) -> SurfaceKernel {
    SurfaceKernel::new(shape, &patches(shape, Division::NONE), 1e-4).unwrap()
}

/// What is known of a shape.
fn reference(name: &str) -> Value {
    let text = std::fs::read_to_string(Path::new("tests/data/shapes").join(format!("{name}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn rms_relative(found: &[f64], want: &[f64]) -> f64 {
    let squares = found.iter().zip(want).map(|(a, b)| (a / b - 1.0).powi(2));
    (squares.sum::<f64>() / want.len() as f64).sqrt()
}

fn v(angle_deg: f64, rows: usize, cols: usize) -> (Fold, Shape) {
    let valley = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows, cols }).unwrap();
    (valley, Accordion { valley, creases: 1, ridge_deg: 90.0, bow_deg: 0.0 }.shape().unwrap())
}

/// A box seen from within: six faces, each divided into n x n.
fn box_within(sides: [f64; 3], n: usize) -> Shape {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for axis in 0..3 {
        for (end, place) in [(0, 0.0), (1, sides[axis])] {
            let first = vertices.len();
            for (i, j) in (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j))) {
                let mut point = [0.0; 3];
                point[axis] = place;
                point[(axis + 1) % 3] = sides[(axis + 1) % 3] * i as f64 / n as f64;
                point[(axis + 2) % 3] = sides[(axis + 2) % 3] * j as f64 / n as f64;
                vertices.push(point);
            }
            let at = |i: usize, j: usize| first + i * (n + 1) + j;
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let mut corners = vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                if end == 1 {
                    corners.reverse();
                }
                faces.push(corners);
            }
        }
    }
    Shape::new(vertices, faces, vec![]).unwrap().0
}

#[test]
fn all_light_in_a_closed_box_stays_there() {
    for sides in [[1.0, 1.0, 1.0], [1.0, 0.2, 3.0]] {
        let kernel = kernel(&box_within(sides, 3));
        assert!(largest_difference(&kernel.row_sums(), &vec![1.0; 54]) < 1e-6);
        assert_eq!((kernel.census().hidden, kernel.census().walled), (0, 0));
    }
}

/// A mesh so large exchanges light by clusters. Every patch sees nothing but the surface: with reflectance r,
/// and as much light of its own as any other, it gets 1/(1 − r) times that.
#[test]
fn a_large_closed_box_keeps_all_its_light() {
    let n = 41;
    let shape = box_within([1.0, 0.6, 1.5], n);
    let kernel = SurfaceKernel::new(&shape, &patches(&shape, Division::NONE), 5e-3).unwrap();
    assert_eq!(
        kernel.census(),
        Census { averted: 3 * n.pow(2) * (n.pow(2) - 1), open: 15 * n.pow(4), walled: 0, hidden: 0 }
    );
    assert!(kernel.entries() < n.pow(4), "{}", kernel.entries());
    assert!(largest_difference(&kernel.row_sums(), &vec![1.0; shape.len()]) < 5e-5);
    let response = SurfaceResponse::solve(&kernel, &vec![1.0; shape.len()], 1e-6).unwrap().0;
    for facet in (0..shape.len()).step_by(701) {
        assert!((response.irradiance(facet, 0.9) - 10.0).abs() < 10.0 * 5e-4, "{facet}");
    }
    let row = kernel.matrix_row(7);
    for other in (2 * n * n..shape.len()).step_by(997) {
        let (there, back) =
            (row[other] * shape.facet(7).area(), kernel.matrix_row(other)[7] * shape.facet(other).area());
        assert!((there / back - 1.0).abs() < 1e-9, "{there} {back}");
    }
}

/// From within a sphere, which is curved everywhere and a caster of every facet, any part sees of every other
/// its share of the whole area.
#[test]
fn all_parts_of_a_sphere_see_each_other_alike() {
    let (rows, cols) = (32, 100);
    let point = |row: usize, col: usize| {
        let (polar, round) = (PI * row as f64 / rows as f64, 2.0 * PI * (col % cols) as f64 / cols as f64);
        let out = if row == rows { 0.0 } else { polar.sin() };
        [out * round.cos(), out * round.sin(), polar.cos()]
    };
    let point = &point;
    let vertices = (0..=rows).flat_map(|row| (0..cols).map(move |col| point(row, col))).collect();
    let at =
        |row: usize, col: usize| if row.is_multiple_of(rows) { row * cols } else { row * cols + col % cols };
    let face = |row: usize, col: usize| {
        let mut corners = vec![at(row, col), at(row, col + 1), at(row + 1, col + 1), at(row + 1, col)];
        corners.dedup();
        corners
    };
    let face = &face;
    let faces = (0..rows).flat_map(|row| (0..cols).map(move |col| face(row, col))).collect();
    let shape = Shape::new(vertices, faces, vec![]).unwrap().0;
    let kernel = SurfaceKernel::new(&shape, &patches(&shape, Division::NONE), 1e-2).unwrap();
    assert!(largest_difference(&kernel.row_sums(), &vec![1.0; shape.len()]) < 1e-4);
    let total: f64 = shape.facets().map(Polygon::area).sum();
    let row = kernel.matrix_row(800);
    for (other, facet) in shape.facets().enumerate().step_by(37).filter(|(other, _)| *other > 1600) {
        assert!((row[other] * total / facet.area() - 1.0).abs() < 1e-2, "{other}");
    }
}

/// Howell, *A Catalog of Radiation Heat Transfer Configuration Factors*, C-11 and C-14: unit squares face to
/// face and at a right angle.
#[test]
fn faces_of_a_cube_have_textbook_factors() {
    let row = kernel(&box_within([1.0, 1.0, 1.0], 1)).matrix_row(0);
    assert!((row[1] - 0.199_824_895_698_387).abs() < 1e-7);
    assert!(row[2..].iter().all(|factor| (factor - 0.200_043_776_075_403).abs() < 1e-7));
}

#[test]
fn corner_and_valleys_have_the_row_sums_of_the_reference() {
    for name in ["corner", "w_60_60", "w_60_100"] {
        let reference = reference(name);
        let sums = kernel(&shape(name)).row_sums();
        match reference.get("row_sum_exact") {
            Some(exact) => assert!(largest_difference(&sums, &numbers(exact)) < 1e-6, "{name}"),
            None => assert!(largest_difference(&sums, &numbers(&reference["row_sum"])) < 2e-4, "{name}"),
        }
    }
}

/// The ridge is as high as the outer edges: lines of sight between the outer panels just touch it.
#[test]
fn grazing_panels_do_not_see_each_other() {
    let kernel = kernel(&shape("w_60_60"));
    for facet in 0..144 {
        let row = kernel.matrix_row(facet);
        let (own, other) = if facet < 72 { (0..72, 72..144) } else { (72..144, 0..72) };
        assert!(row[other].iter().all(|entry| *entry == 0.0), "facet {facet}");
        assert!(row[own].iter().any(|entry| *entry > 0.0));
    }
}

#[test]
fn a_v_of_facets_has_the_kernel_of_the_fold() {
    for angle_deg in [20.0, 60.0, 90.0, 150.0] {
        let (fold, shape) = v(angle_deg, 6, 5);
        let (kernel, exact) = (kernel(&shape), form_factors(&fold));
        for facet in 0..shape.len() {
            let off = largest_difference(&kernel.matrix_row(facet), &exact.matrix_row(facet));
            assert!(off < 1e-7, "{angle_deg}°, facet {facet}: {off:e}");
        }
    }
}

#[test]
fn a_v_of_facets_has_the_irradiance_of_the_fold() {
    let (fold, shape) = v(60.0, 6, 6);
    let (response, _) = respond(Method::Exact, &fold, Mesh::Facets, 1e-9).unwrap();
    let sun = LightSource::directional([0.0, 0.0, 1.0], 1.0).unwrap();
    let solved = solve(&shape, &[sun], Mesh::Facets, 1e-8).unwrap();
    for facet in 0..72 {
        let even = ModeLight::Sun([0.5; 2]);
        let want = response.irradiance(facet / 36, facet % 36, even, [0.9; 2]);
        assert!((solved.responses[0].irradiance(facet, 0.9) / want - 1.0).abs() < 1e-6);
    }
}

/// A facet's irradiance at a reflectance.
fn irradiances(solved: &Solved, r: f64) -> Vec<f64> {
    let response = &solved.responses[0];
    (0..response.facets()).map(|facet| response.irradiance(facet, r)).collect()
}

/// How far every facet is off, relative to itself or, in the dark, to a tenth of the mean: what
/// `facet_mean_error` is about.
fn errors(found: &[f64], want: &[f64]) -> Vec<f64> {
    let dark = 0.1 * want.iter().sum::<f64>() / want.len() as f64;
    found.iter().zip(want).map(|(found, want)| (found - want).abs() / want.max(dark)).collect()
}

/// Both lights, reflectances 0.2, 0.5 and 0.9: facet means within 0.3 % rms of random walks, and each within
/// what is stated but for four standard errors of the walks.
#[test]
fn irradiances_are_those_of_the_random_walks() {
    for name in ["corner", "w_60_60", "w_60_100"] {
        let reference = reference(name);
        for case in reference["cases"].as_array().unwrap() {
            let towards = numbers(&case["light_towards"]);
            let sun = LightSource::directional([towards[0], towards[1], towards[2]], 1.0).unwrap();
            let [fine, flat] =
                [Mesh::Auto, Mesh::Facets].map(|mesh| solve(&shape(name), &[sun], mesh, 5e-3).unwrap());
            for (n, r) in [0.2, 0.5, 0.9].into_iter().enumerate() {
                let want = numbers(case["E"].get(n).unwrap_or_else(|| &case["E"][r.to_string()]));
                let [rms, rms_flat] = [&fine, &flat].map(|solved| {
                    let response = &solved.responses[0];
                    let found: Vec<f64> =
                        (0..response.facets()).map(|facet| response.irradiance(facet, r)).collect();
                    rms_relative(&found, &want)
                });
                println!(
                    "{name} light {towards:.2?} r = {r}: off by {:.3} % rms, one patch per facet {:.2} %",
                    100.0 * rms,
                    100.0 * rms_flat
                );
                assert!(rms < 3e-3 && rms < rms_flat, "{name} {towards:?} r = {r}: {rms} {rms_flat}");
                let stated = fine.accuracy.facet_mean_error.unwrap();
                let walks = numbers(case["E_se"].get(n).unwrap_or_else(|| &case["E_se"][r.to_string()]));
                let errors = errors(&irradiances(&fine, r), &want);
                let off: Vec<_> = errors.iter().map(|error| format!("{:.2}", 1e3 * error)).collect();
                println!("    stated {:.2}e-3; facets, e-3: {}", 1e3 * stated, off.join(" "));
                for (facet, error) in errors.iter().enumerate() {
                    let walks = 4.0 * walks[facet] / want[facet];
                    assert!(*error < stated + walks, "{name} {towards:?} r = {r}, facet {facet}: {error}");
                }
            }
        }
    }
}

/// Five unit squares, each divided into n x n: a box without a lid.
fn open_box(n: usize) -> Shape {
    let (shape, side) = (box_within([1.0; 3], n), n * n);
    // the last of the six is the lid
    let faces = (0..5 * side).map(|facet| shape.corners(facet).to_vec()).collect();
    Shape::new(shape.vertices().to_vec(), faces, vec![]).unwrap().0
}

/// Each facet is within the error that is stated of a solution with a quarter of it, whose own error counts
/// as well. Slanted light, and shadows that end inside facets, but for a single V.
#[test]
fn stated_errors_hold_beside_finer_solutions() {
    let w = |angle_deg: f64, ridge_deg: f64, n: usize| {
        let valley = Fold::new(angle_deg, 1.0, 1.0, FacetGrid { rows: n, cols: n }).unwrap();
        Accordion { valley, creases: 3, ridge_deg, bow_deg: 0.0 }.shape().unwrap()
    };
    let slanted = [0.3, 0.8, 1.0];
    let cases = [
        ("W of 50 and 80 degrees", w(50.0, 80.0, 2), slanted),
        ("W of 60 and 100 degrees", w(60.0, 100.0, 2), slanted),
        ("W of 30 and 60 degrees", w(30.0, 60.0, 1), [0.5, 0.2, 0.8]),
        ("V of 45 degrees", v(45.0, 1, 1).1, [0.0, 0.0, 1.0]),
        ("V of 45 degrees", v(45.0, 3, 3).1, slanted),
        ("open box", open_box(1), slanted),
        ("open box", open_box(2), [0.2, 0.5, 1.0]),
    ];
    for (name, shape, towards) in cases {
        let sun = LightSource::directional(towards, 1.0).unwrap();
        let [coarse, fine] =
            [4e-2, 1e-2].map(|tolerance| solve(&shape, &[sun], Mesh::Auto, tolerance).unwrap());
        let [stated, left] = [&coarse, &fine].map(|solved| solved.accuracy.facet_mean_error.unwrap());
        assert!(stated <= 4e-2 && left <= 1e-2, "{name}: {stated} {left}");
        for r in [0.2, 0.5, 0.9] {
            let errors = errors(&irradiances(&coarse, r), &irradiances(&fine, r));
            let off: Vec<_> = errors.iter().map(|error| format!("{:.1}", 1e3 * error)).collect();
            println!("{name}, r = {r}: stated {:.1}e-3; facets, e-3: {}", 1e3 * stated, off.join(" "));
            let worst = errors.into_iter().fold(0.0, f64::max);
            assert!(worst < stated + left, "{name} r = {r}: off by {worst}, stated {stated}");
        }
    }
}

/// Shadows that end inside facets, valleys on all sides.
#[test]
fn an_open_box_with_shadows_reaches_a_thousandth() {
    let sun = LightSource::directional([0.3, 0.8, 1.0], 1.0).unwrap();
    let solved = solve(&open_box(2), &[sun], Mesh::Auto, 1e-3).unwrap();
    assert!(solved.accuracy.facet_mean_error.unwrap() <= 1e-3, "{:?}", solved.accuracy);
}

/// Of facets in which a shadow ends the reference has a grid of 3000 x 3000 points.
#[test]
fn shadows_end_where_the_reference_has_them() {
    for name in ["corner", "w_60_60", "w_60_100"] {
        let (shape, reference) = (shape(name), reference(name));
        for case in reference["cases"].as_array().unwrap() {
            let towards = numbers(&case["light_towards"]);
            let light =
                sunlight(&shape, &patches(&shape, Division::NONE), &Vec3::from_column_slice(&towards));
            assert!(largest_difference(&light, &numbers(&case["direct_E0"])) < 2e-4, "{name}");
        }
    }
}

/// A screen half-way between two squares that hides all of one from the other, or all but what is seen past
/// its side.
#[test]
fn a_screen_hides_what_is_behind_it() {
    let square = |z: f64, x: [f64; 2]| [[x[0], 0.0, z], [x[1], 0.0, z], [x[1], 1.0, z], [x[0], 1.0, z]];
    let factor = |screen: Option<[f64; 2]>| {
        let mut vertices = [square(0.0, [0.0, 1.0]), square(1.0, [0.0, 1.0])].concat();
        let mut faces = vec![vec![0, 1, 2, 3], vec![7, 6, 5, 4]];
        if let Some(x) = screen {
            vertices.extend(square(0.5, x));
            faces.push(vec![8, 9, 10, 11]);
        }
        kernel(&Shape::new(vertices, faces, vec![]).unwrap().0).matrix_row(0)[1]
    };
    let open = factor(None);
    assert!((open - 0.199_824_895_698_387).abs() < 1e-7);
    assert_eq!(factor(Some([0.0, 1.0])).to_bits(), 0.0_f64.to_bits());
    // Lines past either side of half a screen are each other's mirror image, and cross no other line that is
    // free.
    let (left, right) = (factor(Some([0.0, 0.5])), factor(Some([0.5, 1.0])));
    assert!((left - right).abs() < 1e-4 && (left + right - open).abs() < 2e-4, "{left} {right} {open}");
}

#[test]
fn what_is_not_needed_is_counted() {
    let census = kernel(&v(60.0, 2, 2).1).census();
    assert_eq!(census, Census { averted: 12, open: 16, walled: 0, hidden: 0 });
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// No facet hands on more light than it has, what two hand each other agrees, and neither size nor place
    /// matters.
    #[test]
    fn accordions_obey_the_laws(
        angle_deg in 20.0..150.0,
        ridge_deg in 30.0..170.0,
        creases in 1_usize..4,
        bow_deg in -40.0..60.0,
        size in 1e-3..1e3,
    ) {
        let valley = Fold::new(angle_deg, 1.0, 0.7, FacetGrid { rows: 3, cols: 2 }).unwrap();
        let shape = Accordion { valley, creases, ridge_deg, bow_deg }.shape();
        prop_assume!(shape.is_ok(), "panels pass through each other");
        let shape = shape.unwrap();
        let first = kernel(&shape);
        prop_assert!(first.row_sums().iter().all(|sum| (0.0..1.0).contains(sum)));
        for i in 0..shape.len() {
            for (j, there) in first.matrix_row(i).iter().enumerate() {
                let back = first.matrix_row(j)[i] * shape.facet(j).area();
                prop_assert!((there * shape.facet(i).area() - back).abs() < 1e-12);
            }
        }
        let turn = nalgebra::Rotation3::<f64>::from_euler_angles(0.3, 1.1, -0.4);
        let moved = |point: &[f64; 3]| -> [f64; 3] {
            let scaled: Vec3 = Vec3::from(*point) * size;
            let turned: Vec3 = turn * scaled;
            (turned + Vec3::new(5.0, 1.0, -2.0)).into()
        };
        let vertices = shape.vertices().iter().map(moved).collect();
        let faces = (0..shape.len()).map(|facet| shape.corners(facet).to_vec()).collect();
        let second = kernel(&Shape::new(vertices, faces, vec![]).unwrap().0);
        prop_assert!(largest_difference(&first.row_sums(), &second.row_sums()) < 1e-3);
    }
}
