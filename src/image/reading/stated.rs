//! Statements of a picture file on its own numbers: their curve and colour space.
//!
//! A picture without statements is read by its depth. One with contradictory statements, or with one that
//! cannot be undone here, is refused: only its author knows.

use std::path::Path;

use crate::image::numbers::Transfer;
use crate::{Error, Result};

/// One statement of a file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Statement {
    /// Where it is made.
    pub by: &'static str,
    /// The curve; or a description if it is no curve of [`Transfer`], or if the colours are neither a
    /// camera's own nor sRGB's.
    pub says: std::result::Result<Transfer, String>,
}

/// Objection to a curve.
pub(super) const OTHER_CURVE: &str = "whose curve is neither linear nor sRGB's";
/// Objection to colours: a matrix that the file does not contain computed them from a camera's.
pub(super) const OTHER_COLOURS: &str = "whose primaries are not sRGB's";
/// What a statement says that is damaged, or not of its kind.
pub(super) const UNREADABLE: &str = "something that cannot be read";

/// Largest difference between equal curves: gamma 2.2 is 0.009 from sRGB's, tables of it with a few rows
/// 0.001.
const SAME_CURVE: f64 = 2e-3;

/// How to read it nevertheless.
const REMEDY: &str = "export it again, linear or as sRGB, or state with --transfer linear or srgb how \
                      to read its numbers";

/// The curve on which the file's statements agree, none if there are none.
///
/// # Errors
/// [`Error::Picture`] if they contradict each other, or one cannot be undone.
pub(super) fn curve(path: &Path, statements: &[Statement]) -> Result<Option<Transfer>> {
    let mut agreed: Option<(&str, Transfer)> = None;
    for Statement { by, says } in statements {
        let refused = |problem: String| Err(Error::picture(path, problem, REMEDY));
        match (says, agreed) {
            (Err(what), _) => return refused(format!("its {by} says {what}")),
            (Ok(curve), Some((first, other))) if *curve != other => {
                let (other, curve) = (other.name(), curve.name());
                return refused(format!("its {first} says {other}, its {by} {curve}"));
            }
            (Ok(curve), _) => agreed = Some((by, *curve)),
        }
    }
    Ok(agreed.map(|(_, curve)| curve))
}

/// The known curve equal to this one, which maps stored numbers in [0, 1] to linear light.
pub(super) fn curve_like(to_linear: impl Fn(f64) -> f64) -> Option<Transfer> {
    let is = |curve: &Transfer| {
        (0..=255)
            .map(|step| f64::from(step) / 255.0)
            .all(|stored| (to_linear(stored) - curve.to_linear(stored)).abs() < SAME_CURVE)
    };
    [Transfer::Linear, Transfer::Srgb].into_iter().find(is)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn note(says: &[std::result::Result<Transfer, &str>]) -> Result<Option<Transfer>> {
        let says = says.iter().zip(["EXIF", "ICC profile", "chunk sRGB"]);
        let statement = |(says, by): (&std::result::Result<Transfer, &str>, _)| Statement {
            by,
            says: says.map_err(str::to_owned),
        };
        curve(Path::new("a.png"), &says.map(statement).collect::<Vec<_>>())
    }

    #[test]
    fn what_agrees_is_believed_and_the_rest_refused() {
        let (linear, srgb) = (Ok(Transfer::Linear), Ok(Transfer::Srgb));
        assert_eq!(note(&[]).unwrap(), None);
        assert_eq!(note(&[srgb, srgb]).unwrap(), Some(Transfer::Srgb));
        let refused = note(&[srgb, linear]).unwrap_err().to_string();
        assert!(refused.starts_with("a.png: its EXIF says srgb, its ICC profile linear; "), "{refused}");
        let refused = note(&[srgb, Err("'ProPhoto'")]).unwrap_err().to_string();
        assert!(
            refused.contains("its ICC profile says 'ProPhoto'; ") && refused.contains("--transfer"),
            "{refused}"
        );
    }
}
