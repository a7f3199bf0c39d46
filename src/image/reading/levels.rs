//! The numbers for black and white that a picture file states.
//!
//! Other numbers than those assumed here are not guessed from a tag that few programs write or read: the user
//! confirms them.

use std::path::Path;

use crate::image::numbers::{ReadOptions, Scale};
use crate::{Error, Result};

/// Black and white as a file states them: one number for all colours or one for each, or none.
pub(super) struct Levels {
    /// Where they are stated.
    pub by: &'static str,
    pub black: Vec<f64>,
    pub white: Vec<f64>,
}

/// Relative tolerance within which two levels are equal.
const SAME: f64 = 1e-6;

impl Levels {
    /// # Errors
    /// [`Error::Picture`] if a level is stated that is neither that of `scale` nor overridden by the user.
    pub fn check(&self, path: &Path, scale: &Scale, options: &ReadOptions) -> Result<()> {
        let level = |name, stated: &[f64], assumed: f64, option: Option<f64>| {
            let is_same = |one: &f64| (one - assumed).abs() <= SAME * scale.white;
            let is_other = !stated.iter().all(is_same);
            (is_other && option.is_none()).then(|| Other { name, stated: stated.to_vec(), assumed })
        };
        let others = [
            level("black", &self.black, scale.black, options.black_level),
            level("white", &self.white, scale.white, options.white_level),
        ];
        let others: Vec<_> = others.into_iter().flatten().collect();
        if others.is_empty() {
            return Ok(());
        }
        let all = |word: fn(&Other) -> String| others.iter().map(word).collect::<Vec<_>>().join(" and ");
        let problem = format!("by its {}, {}", self.by, all(Other::is));
        Err(Error::picture(
            path,
            problem,
            format!("state how to read its numbers, with {}", all(Other::flag)),
        ))
    }
}

/// A level that the file states and vfold does not assume.
struct Other {
    name: &'static str,
    stated: Vec<f64>,
    assumed: f64,
}

impl Other {
    fn is(&self) -> String {
        let mut stated = self.stated.clone();
        stated.dedup();
        let stated = stated.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
        format!("{} is {stated} instead of {}", self.name, self.assumed)
    }

    fn flag(&self) -> String {
        format!("--{}-level {}", self.name, self.stated[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(black: &[f64], white: &[f64], options: &ReadOptions) -> Option<String> {
        let levels = Levels { by: "ReferenceBlackWhite", black: black.to_vec(), white: white.to_vec() };
        let scale = Scale::new(options, 16).unwrap();
        levels.check(Path::new("a.tif"), &scale, options).err().map(|error| error.to_string())
    }

    #[test]
    fn levels_other_than_those_assumed_are_refused_unless_the_user_states_them() {
        let assumed = ReadOptions::default();
        assert_eq!(check(&[0.0; 3], &[65535.0; 3], &assumed), None);
        assert_eq!(check(&[], &[], &assumed), None);
        assert_eq!(
            check(&[512.0; 3], &[4095.0; 3], &assumed).unwrap(),
            "a.tif: by its ReferenceBlackWhite, black is 512 instead of 0 and white is 4095 instead of \
             65535; state how to read its numbers, with --black-level 512 and --white-level 4095"
        );
        let stated = ReadOptions { white_level: Some(4095.0), ..assumed };
        assert_eq!(check(&[0.0], &[4095.0; 3], &stated), None);
        assert!(check(&[5.0, 7.0], &[], &stated).unwrap().contains("black is 5, 7 instead of 0;"));
        assert!(check(&[f64::NAN], &[], &assumed).is_some());
    }
}
