//! Statements of a directory on its page's numbers.

use super::directory::Directory;
use super::tags::{PHOTOMETRIC, PRIMARIES, PROFILE, TRANSFER_FUNCTION, WHITE_POINT};
use crate::image::numbers::Transfer;
use crate::image::reading::icc;
use crate::image::reading::primaries::{SRGB, are_srgb};
use crate::image::reading::stated::{OTHER_COLOURS, OTHER_CURVE, Statement, curve_like};

/// ICC profile, curve and primaries.
pub(super) fn statements(page: &Directory) -> Vec<Statement> {
    let is_grey = matches!(page.number(PHOTOMETRIC), Some(0 | 1));
    let profile = page.bytes(PROFILE).map(|profile| icc::statement(profile, !is_grey));
    let curve = page.has(TRANSFER_FUNCTION).then(|| Statement {
        by: "TransferFunction",
        says: transfer(page).ok_or_else(|| format!("something {OTHER_CURVE}")),
    });
    let colours = has_other_primaries(page).then(|| Statement {
        by: "PrimaryChromaticities",
        says: Err(format!("a colour space {OTHER_COLOURS}")),
    });
    [profile, curve, colours].into_iter().flatten().collect()
}

/// The curve by which one table, or one for each of three colours, maps stored numbers to light between black
/// and white.
fn transfer(page: &Directory) -> Option<Transfer> {
    let tables: Vec<f64> =
        page.numbers(TRANSFER_FUNCTION)?.into_iter().map(|light| light as f64 / 65535.0).collect();
    let colours = if tables.len().is_power_of_two() { 1 } else { 3 };
    let numbers = tables.len() / colours;
    if numbers < 2 {
        return None;
    }
    let tones = tables
        .chunks_exact(numbers)
        .map(|table| curve_like(|stored| table[(stored * (numbers - 1) as f64).round() as usize]));
    let [first, others @ ..] = &tones.collect::<Option<Vec<_>>>()?[..] else { return None };
    others.iter().all(|other| other == first).then_some(*first)
}

/// Whether it states primaries or a white other than sRGB's.
fn has_other_primaries(page: &Directory) -> bool {
    let [red, green, blue, white] = SRGB;
    let pairs = |tag: u16, count: usize, otherwise: &[[f64; 2]]| match page.reals(tag) {
        Some(reals) if reals.len() == 2 * count => reals.chunks_exact(2).map(|xy| [xy[0], xy[1]]).collect(),
        _ => otherwise.to_vec(),
    };
    let mut corners = pairs(PRIMARIES, 3, &[red, green, blue]);
    corners.extend(pairs(WHITE_POINT, 1, &[white]));
    <[_; 4]>::try_from(corners).is_ok_and(|corners| !are_srgb(&corners))
}

#[cfg(test)]
mod tests {
    use super::super::directory::{file, read_all};
    use super::super::tags::{RATIONAL, SHORT};
    use super::*;

    /// The statements of a page with one tag, whose values are these bytes.
    fn of(tag: u16, kind: u16, count: u32, bytes: &[u8]) -> Vec<Statement> {
        let mut whole = file(&[&[(tag, kind, count, 26)]]);
        assert_eq!(whole.len(), 26);
        whole.extend(bytes);
        statements(&read_all(&mut std::io::Cursor::new(&whole), whole.len() as u64).unwrap()[0])
    }

    fn table(numbers: usize, to_linear: impl Fn(f64) -> f64) -> Vec<u8> {
        let light = |n: usize| (65535.0 * to_linear(n as f64 / (numbers - 1) as f64)).round() as u16;
        (0..numbers).flat_map(|n| light(n).to_le_bytes()).collect()
    }

    #[test]
    fn transfer_functions_are_ours_or_refused() {
        let says = |tables: Vec<u8>| {
            let statement = of(TRANSFER_FUNCTION, SHORT, tables.len() as u32 / 2, &tables);
            assert_eq!(statement.len(), 1);
            statement[0].says.clone()
        };
        let srgb = |stored| Transfer::Srgb.to_linear(stored);
        let power = |stored: f64| stored.powf(2.2);
        for numbers in [256, 65536] {
            assert_eq!(says(table(numbers, |stored| stored)), Ok(Transfer::Linear));
            assert_eq!(says(table(numbers, srgb).repeat(3)), Ok(Transfer::Srgb));
            assert!(says(table(numbers, power)).unwrap_err().contains("neither linear nor sRGB"));
            let mixed = [table(numbers, srgb).repeat(2), table(numbers, power)].concat();
            assert!(says(mixed).is_err());
        }
        assert!(says(vec![0; 6]).is_err());
    }

    #[test]
    fn primaries_are_srgbs_or_refused() {
        let ratios = |numbers: &[u32]| {
            numbers
                .iter()
                .flat_map(|n| [n.to_le_bytes(), 10_000_u32.to_le_bytes()].concat())
                .collect::<Vec<_>>()
        };
        let primaries = |numbers: &[u32]| of(PRIMARIES, RATIONAL, 6, &ratios(numbers));
        assert_eq!(primaries(&[6400, 3300, 3000, 6000, 1500, 600]), []);
        let adobe = &primaries(&[6400, 3300, 2100, 7100, 1500, 600])[0];
        assert!(adobe.says.as_ref().unwrap_err().contains("whose primaries are not sRGB's"));
        assert_eq!(of(WHITE_POINT, RATIONAL, 2, &ratios(&[3127, 3290])), []);
        assert_eq!(of(WHITE_POINT, RATIONAL, 2, &ratios(&[3457, 3585])).len(), 1);
    }
}
