//! Names of spectra: which are equal, and which may have been meant.

use clap::ValueEnum;

use crate::error::Error;

/// The kinds of spectra.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum What {
    /// Camera sensitivities.
    Cameras,
    /// Illuminants.
    Illuminants,
    /// Reflectances and sets of them.
    Reflectances,
}

/// Ignores case and spaces: `5R 6/12` is `5R6/12`.
pub(super) fn same_name(a: &str, b: &str) -> bool {
    plain(a).eq(plain(b))
}

fn plain(name: &str) -> impl Iterator<Item = u8> {
    name.bytes().filter(|&letter| letter != b' ').map(|letter| letter.to_ascii_lowercase())
}

/// Lower-case words of letters and digits.
pub(super) fn words(text: &str) -> impl Iterator<Item = String> {
    text.split(|letter: char| !letter.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_lowercase)
}

/// The error for a name that is not among `known`, with the nearest of them.
pub(super) fn unknown<'a>(what: What, name: &str, known: impl Iterator<Item = &'a str>) -> Error {
    let (kind, list) = match what {
        What::Cameras => ("camera", "cameras"),
        What::Illuminants => ("illuminant", "illuminants"),
        What::Reflectances => ("reflectance", "reflectances"),
    };
    let near = nearest(name, known);
    let meant = if near.is_empty() { String::new() } else { format!("did you mean {}? ", near.join(" or ")) };
    let hint =
        format!("{meant}vextract --list {list} shows all names, and a file needs its ending, such as .csv");
    Error::UnknownName { kind, name: name.to_owned(), hint }
}

/// Up to three of `known`, nearest first, that `name` may mean: they differ by a few letters, or contain it.
pub(super) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut near: Vec<_> = known.map(|known| (edits(name, known), known)).collect();
    near.retain(|&(edits, known)| edits <= 1 + name.len() / 3 || known.contains(&name.to_lowercase()));
    near.sort_by_key(|&(edits, _)| edits);
    near.iter().take(3).map(|&(_, known)| known).collect()
}

/// Up to three of `known` that a name may mean, nearest first. Both may be compound, as `cc24:red`: a member
/// may be meant without its set, or as one of another.
///
/// # Example
/// ```
/// use vfold::spectrum::near_names;
/// assert_eq!(near_names("cc24:red", ["truth:rde", "truth:white"]), ["truth:rde"]);
/// ```
#[must_use]
pub fn near_names<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let member = |name: &'a str| name.split_once(':').map_or(name, |(_, member)| member);
    let all: Vec<(&str, &str)> = known.into_iter().map(|known| (member(known), known)).collect();
    let of_members = |name: &str| nearest(name, all.iter().map(|(member, _)| *member));
    let mut near = of_members(name);
    if let Some((_, member)) = name.split_once(':')
        && near.is_empty()
    {
        near = of_members(member);
    }
    let whole = |member: &&str| all.iter().find(|(known, _)| known == member).map(|(_, whole)| *whole);
    near.iter().filter_map(whole).collect()
}

/// Levenshtein distance, ignoring case.
fn edits(a: &str, b: &str) -> usize {
    let (a, b) = (a.to_lowercase(), b.to_lowercase());
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, to) in b.chars().enumerate() {
            let replaced = diagonal + usize::from(from != to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.chars().count()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn part_of_a_name_is_near() {
        assert_eq!(nearest("Nikon", ["canon-5d-mark-ii", "nikon-d5100"].into_iter()), ["nikon-d5100"]);
    }

    /// The textbook distances.
    #[test]
    fn edits_are_levenshteins() {
        for (a, b, want) in
            [("kitten", "sitting", 3), ("Saturday", "sunday", 3), ("", "abc", 3), ("d65", "D65", 0)]
        {
            assert_eq!((edits(a, b), edits(b, a)), (want, want), "{a} {b}");
        }
    }
}
