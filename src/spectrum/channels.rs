//! Assigns the columns of a file to the channels of a camera: by name, in any order.

use super::Spectrum;
use super::names::words;
use crate::error::{Error, Result};

/// Words in column names that denote the colours, in the order of a camera's channels.
const COLOURS: [&[&str]; 3] =
    [&["r", "red"], &["g", "green", "g1", "g2", "gr", "gb", "green1", "green2"], &["b", "blue"]];
const GREEN: usize = 1;
/// Peaks of channels that differ by less than this fraction count as equal. Those of built-in cameras with a
/// common scale differ by at least a fifth.
const SAME_PEAK: f64 = 0.01;

/// Index among R, G and B given by the name of a column: `R`, `Red channel`, `Canon R`, `G1`.
fn place(name: &str) -> Option<usize> {
    let mut places = words(name).filter_map(|word| COLOURS.iter().position(|words| words.contains(&&*word)));
    let first = places.next()?;
    places.all(|other| other == first).then_some(first)
}

/// True if the name of a column says which of two greens it is: `G1`, `Green 2`, `Gr`.
fn is_one_of_two(name: &str) -> bool {
    words(name).any(|word| matches!(word.as_str(), "gr" | "gb") || word.ends_with(['1', '2']))
}

/// The channels of a camera's file in the order R, G, B, with the mean of two greens, and notes on what was
/// done. Columns whose names give no colour keep their order.
///
/// # Errors
/// [`crate::Error::Spectrum`] if two columns have the same colour, or if names give the colours of some
/// columns but not of all channels.
pub(super) fn in_order(path: &str, columns: &[Spectrum]) -> Result<(Vec<Spectrum>, Vec<String>)> {
    const NAME_THEM: &str = "name the columns R, G and B";
    let places: Vec<_> = columns.iter().map(|column| place(column.name())).collect();
    let list = |columns: &[&Spectrum]| columns.iter().map(|one| one.name()).collect::<Vec<_>>().join(", ");
    let nameless: Vec<&Spectrum> =
        columns.iter().zip(&places).filter(|(_, place)| place.is_none()).map(|(column, _)| column).collect();
    let (mut channels, mut notes) = (Vec::new(), Vec::new());
    for colour in 0..COLOURS.len() {
        let of_colour = columns.iter().zip(&places).filter(|(_, place)| **place == Some(colour));
        match of_colour.map(|(column, _)| column).collect::<Vec<_>>()[..] {
            [] => {}
            [one] => channels.push(one.clone()),
            [a, b] if colour == GREEN && is_one_of_two(a.name()) && is_one_of_two(b.name()) => {
                channels.push(mean("G", a, b));
                notes.push(format!("G is the mean of {} and {}", a.name(), b.name()));
            }
            ref several => {
                let problem = format!("the columns {} have the same colour", list(several));
                return Err(Error::spectrum(
                    path,
                    problem,
                    format!("{NAME_THEM}, G1 and G2 if there are two greens"),
                ));
            }
        }
    }
    let all: Vec<&Spectrum> = columns.iter().collect();
    match nameless.len() {
        0 if places.is_sorted() => {}
        0 => notes.push(format!("channels {} put in the order R, G, B", list(&all))),
        _ if channels.len() == COLOURS.len() => {
            notes.push(format!("channels R, G and B taken by name, {} left out", list(&nameless)));
        }
        _ if channels.is_empty() => {
            channels = columns.to_vec();
            if all.len() == COLOURS.len() {
                notes.push(format!(
                    "channels {} taken as R, G, B by position, as no name gives a colour",
                    list(&all)
                ));
            }
        }
        _ => {
            let problem = format!("the columns {} do not name all of R, G and B", list(&all));
            return Err(Error::spectrum(path, problem, NAME_THEM));
        }
    }
    if have_one_peak(channels.iter().map(Spectrum::values)) {
        notes.push(
            "all channels have the same peak, unlike any camera's: scaled one by one, \
             they have lost their ratios"
                .to_owned(),
        );
    }
    Ok((channels, notes))
}

fn mean(name: &str, a: &Spectrum, b: &Spectrum) -> Spectrum {
    let values = a.values.iter().zip(&b.values).map(|(a, b)| (a + b) / 2.0).collect();
    Spectrum::from_table(name.to_owned(), a.wavelengths_nm.clone(), values)
}

/// True if the two or three channels of a camera have the same peak: they were scaled one by one, and their
/// ratios are lost. More than three channels may well have equal peaks.
///
/// # Example
/// ```
/// use vfold::spectrum::have_one_peak;
/// assert!(have_one_peak([&[0.2, 1.0][..], &[1.0, 0.1]]));
/// assert!(!have_one_peak([&[0.2, 0.9][..], &[1.0, 0.1]]));
/// ```
pub fn have_one_peak<'a>(channels: impl IntoIterator<Item = &'a [f64]>) -> bool {
    let peak = |channel: &[f64]| channel.iter().copied().fold(0.0, f64::max);
    let peaks: Vec<f64> = channels.into_iter().map(peak).collect();
    let (lowest, highest) =
        (peaks.iter().copied().fold(f64::INFINITY, f64::min), peaks.iter().copied().fold(0.0, f64::max));
    (2..=COLOURS.len()).contains(&peaks.len()) && lowest > (1.0 - SAME_PEAK) * highest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ordered(names: &[&str]) -> Result<(Vec<Spectrum>, Vec<String>)> {
        let column = |(at, name): (usize, &&str)| {
            Spectrum::new(*name, vec![400.0, 700.0], vec![1.0 + at as f64, 0.0]).unwrap()
        };
        in_order("x.csv", &names.iter().enumerate().map(column).collect::<Vec<_>>())
    }

    #[test]
    fn channels_are_found_by_name_in_any_order() {
        for (names, want, note) in [
            (&["R", "G", "B"][..], &["R", "G", "B"][..], None),
            (&["B", "G", "R"], &["R", "G", "B"], Some("channels B, G, R put in the order R, G, B")),
            (&["green", "BLUE", "Red"], &["Red", "green", "BLUE"], Some("put in the order")),
            (&["Canon R", "Canon G [a.u.]", "b_channel"], &["Canon R", "Canon G [a.u.]", "b_channel"], None),
            (&["B", "R", "G"], &["R", "G", "B"], Some("put in the order")),
            (&["R", "IR", "G", "B"], &["R", "G", "B"], Some("R, G and B taken by name, IR left out")),
            (&["R", "G1", "G2", "B"], &["R", "G", "B"], Some("G is the mean of G1 and G2")),
            (&["Gr", "Gb", "B", "R"], &["R", "G", "B"], Some("G is the mean of Gr and Gb")),
            (&["x", "y", "z"], &["x", "y", "z"], Some("x, y, z taken as R, G, B by position")),
            (&["R", "G"], &["R", "G"], None),
            (&["Y"], &["Y"], None),
        ] {
            let (channels, notes) = ordered(names).unwrap();
            assert_eq!(channels.iter().map(Spectrum::name).collect::<Vec<_>>(), want);
            assert_eq!(note.is_some(), !notes.is_empty(), "{notes:?}");
            assert!(notes.join("; ").contains(note.unwrap_or("")), "{notes:?}");
        }
        assert_eq!(ordered(&["R", "G1", "G2", "B"]).unwrap().0[1].values(), [2.5, 0.0]);
    }

    #[test]
    fn names_that_leave_it_open_are_refused() {
        for (names, want) in [
            (&["R", "red", "G", "B"][..], "the columns R, red have the same colour"),
            (&["R", "G", "G1", "B"], "the columns G, G1 have the same colour"),
            (&["B", "x", "y"], "the columns B, x, y do not name all of R, G and B"),
        ] {
            let message = ordered(names).unwrap_err().to_string();
            assert!(message.contains(want), "{message}");
        }
    }

    /// Only those published with channels scaled one by one have equal peaks.
    #[test]
    fn built_in_cameras_have_peaks_of_their_own() {
        let sensitivities = crate::spectrum::measured_sensitivities().unwrap();
        let one_peak = sensitivities
            .iter()
            .filter(|sensitivities| have_one_peak(sensitivities.iter().map(Spectrum::values)));
        assert_eq!(one_peak.count(), 2, "ARRI D21, Nikon D5100");
    }
}
