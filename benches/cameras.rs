//! What stands in for a camera that nobody measured, each of the 52 left out in turn: by its colour matrix, by its maker, by neither, and the
//! mean of all others. Errors are root mean squares of the curves over 400 to 700 nm, green's peak being 1.
//!
//! `cargo bench --bench cameras` prints the table of `benches/results/cameras.md`.

#![allow(clippy::print_stdout, reason = "a measurement for the reader of a terminal")]

use vfold::Result;
use vfold::camera::{LeftOut, StandIns};

fn main() -> Result<()> {
    let rows = StandIns::new()?.left_out()?;
    println!("| camera left out | by matrix | error | by maker | error | by neither | error | mean of all |");
    println!("|---|---|---|---|---|---|---|---|");
    for LeftOut { camera, stand_ins, mean_error } in &rows {
        let cells: Vec<_> =
            stand_ins.iter().map(|(stand_in, error)| format!("{} | {error:.4}", stand_in.name)).collect();
        println!("| {camera} | {} | {mean_error:.4} |", cells.join(" | "));
    }
    let mean = |error: &dyn Fn(&LeftOut) -> f64| rows.iter().map(error).sum::<f64>() / rows.len() as f64;
    let [matrix, maker, neither] = [0, 1, 2].map(|k: usize| mean(&|row| row.stand_ins[k].1));
    let of_all = mean(&|row| row.mean_error);
    println!("| **mean** | | **{matrix:.4}** | | **{maker:.4}** | | **{neither:.4}** | **{of_all:.4}** |");
    Ok(())
}
