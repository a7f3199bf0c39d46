//! Writes `munsell1269.npy`, `munsell1269.txt` and `munsell1269-classes.txt` of this folder from the crate
//! `colorimetry`.
//!
//! `cargo run --release --example make-munsell`
//!
//! The crate interpolates each chip to 1 nm, 12 ms for all; the 5 nm data beneath are multiples of 1/50000,
//! so that 16-bit integers hold them without loss and load in a fraction of a millisecond. The classes are
//! those of the prior of `vestimate`, one a line in the order of the names.

use colorimetry::colorant::MunsellCollection;
use npyz::WriterBuilder;
use std::fs::{File, write};
use std::io::BufWriter;
use vfold::estimate::prior::classes_of;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let share = concat!(env!("CARGO_MANIFEST_DIR"), "/share");
    let chips: Vec<_> = MunsellCollection.into_iter().collect();
    let names: String = chips.iter().map(|chip| format!("{}\n", chip.key())).collect();
    write(format!("{share}/munsell1269.txt"), names)?;
    let file = BufWriter::new(File::create(format!("{share}/munsell1269.npy"))?);
    let shape = [chips.len() as u64, 81];
    let mut array = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(file).begin_nd()?;
    for chip in &chips {
        let every_5_nm = chip.spectrum().as_array().iter().step_by(5);
        array.extend(every_5_nm.map(|reflectance| (reflectance * 50_000.0).round() as u16))?;
    }
    array.finish()?;
    let wavelengths_nm: Vec<f64> = (0..61).map(|k| 400.0 + 5.0 * f64::from(k)).collect();
    let spectra: Vec<Vec<f64>> = chips
        .iter()
        .map(|chip| chip.spectrum().as_array().iter().skip(20).step_by(5).take(61).copied().collect())
        .collect();
    let classes: String =
        classes_of(&wavelengths_nm, &spectra).iter().map(|class| format!("{class}\n")).collect();
    Ok(write(format!("{share}/munsell1269-classes.txt"), classes)?)
}
