//! Surfaces of several facets that hide each other, against irradiances found by random walks (`/work/shared/mesh`).

use std::path::Path;
use std::time::Instant;

use serde_json::Value;
use vfold::geometry::{Vec3, obj};
use vfold::kernel::exchange::Exchange;
use vfold::kernel::surface::patches::{Division, patches};
use vfold::kernel::surface::{SurfaceKernel, sunlight::sunlight};

const FOLDER: &str = "../shared/mesh";

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn bounce(kernel: &SurfaceKernel, direct: &[f64], r: f64) -> Vec<f64> {
    let start = kernel.start(direct);
    let (mut x, mut next) = (start.clone(), vec![0.0; start.len()]);
    for _ in 0..200 {
        kernel.apply(&x, &mut next);
        x.iter_mut().zip(&next).zip(&start).for_each(|((x, n), s)| *x = s + r * n);
    }
    kernel.facet_means(&x)
}

#[test]
fn explore() {
    for name in ["corner", "w_60_60", "w_60_100"] {
        let (shape, _) = obj::read(&Path::new(FOLDER).join(format!("{name}.obj"))).unwrap();
        let text = std::fs::read_to_string(Path::new(FOLDER).join(format!("{name}.json"))).unwrap();
        let reference: Value = serde_json::from_str(&text).unwrap();
        for division in [
            Division::NONE,
            Division { cells: 1, strips: 2 },
            Division { cells: 2, strips: 1 },
            Division { cells: 2, strips: 2 },
        ] {
            let begin = Instant::now();
            let kernel = SurfaceKernel::new(&shape, division, 1e-3).unwrap();
            println!(
                "{name} {division:?} {} patches {} entries {:?} {:?}",
                kernel.unknowns(),
                kernel.entries(),
                begin.elapsed(),
                kernel.census()
            );
            let sums = kernel.facet_means(&kernel.start(&kernel.row_sums()));
            let want = numbers(&reference["row_sum"]);
            let worst = sums.iter().zip(&want).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            println!("   row sums off by {worst:.2e}");
            let patches = patches(&shape, division);
            for case in reference["cases"].as_array().unwrap() {
                let towards = numbers(&case["light_towards"]);
                let direct = sunlight(&shape, &patches, &Vec3::new(towards[0], towards[1], towards[2]));
                let means = kernel.facet_means(&kernel.start(&direct));
                let off = means
                    .iter()
                    .zip(numbers(&case["direct_E0"]))
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, f64::max);
                print!("   E0 {off:.1e}");
                for (n, r) in [0.2, 0.5, 0.9].into_iter().enumerate() {
                    let found = bounce(&kernel, &direct, r);
                    let want = match &case["E"] {
                        Value::Array(rows) => numbers(&rows[n]),
                        object => numbers(&object[&format!("{r}")]),
                    };
                    let rms = (found.iter().zip(&want).map(|(a, b)| (a / b - 1.0).powi(2)).sum::<f64>()
                        / want.len() as f64)
                        .sqrt();
                    print!("  r {r} rms {:.3} %", 100.0 * rms);
                }
                println!();
            }
        }
    }
}
