//! Range of a photograph's numbers: black and white level according to its own pixels, whatever its file
//! states.

use super::Photograph;
use super::darkest::darkest;
use super::ends::ends;
use super::sampled::Sampled;
use crate::image::numbers::{Scale, Transfer};

impl Photograph {
    /// The same, clipped where a channel's numbers end early, and with its darkest numbers recorded.
    pub(in crate::image) fn with_limits_detected(mut self) -> Self {
        let sampled = Sampled::of(&self.pixels, self.channels(), (self.width(), self.height()));
        self.info.is_grey = are_alike(&sampled);
        let ends = ends(&sampled);
        if ends.iter().any(Option::is_some) {
            self.pixels.rescale(|channel, scale| match ends.get(channel).or(ends.last()) {
                Some(Some(end)) => scale.ending_at((*end).into()),
                _ => scale,
            });
            self.info.ends_at =
                (0..ends.len()).map(|channel| Some(self.stored(channel, ends[channel]?.into()))).collect();
        }
        if self.info.transfer_used == Transfer::Linear {
            let black: Vec<f64> =
                (0..sampled.len()).map(|channel| self.number(channel, self.black(channel))).collect();
            let found = darkest(&sampled, &black).unwrap_or_default();
            self.info.darkest =
                found.iter().enumerate().map(|(channel, number)| self.stored(channel, *number)).collect();
        }
        self
    }

    /// The same with its darkest numbers as black, if they seem to be the level of no light
    /// ([`darkest`](crate::image::PhotographInfo::darkest)).
    ///
    /// # Example
    /// ```
    /// use vfold::image::{Photograph, Pixel};
    /// let light = vec![0.25, 0.5, 0.75];
    /// let photograph = Photograph::from_light(1, 1, light)?;
    /// assert!(photograph.info().darkest.is_empty());
    /// assert_eq!(photograph.with_darkest_as_black().pixel(0, 0), Pixel::Light([0.25, 0.5, 0.75]));
    /// # Ok::<(), vfold::Error>(())
    /// ```
    #[must_use]
    pub fn with_darkest_as_black(mut self) -> Self {
        let darkest = std::mem::take(&mut self.info.darkest);
        if darkest.is_empty() {
            return self;
        }
        let black: Vec<f64> =
            darkest.iter().enumerate().map(|(channel, stored)| self.number(channel, *stored)).collect();
        self.pixels.rescale(|channel, scale: Scale| scale.with_black(black[channel.min(black.len() - 1)]));
        let white = |channel: usize| {
            let (black, white, darkest) =
                (self.black(channel), level(&self.info.white_level, channel), darkest[channel]);
            if white > darkest { white } else { darkest + white - black }
        };
        self.info.white_level = (0..darkest.len()).map(white).collect();
        self.info.black_level = darkest;
        self
    }

    /// The black level of a channel, in the file's numbers.
    fn black(&self, channel: usize) -> f64 {
        level(&self.info.black_level, channel)
    }

    /// Converts a number of the picture's pixels to that of the file; RAW files have become light.
    fn stored(&self, channel: usize, number: f64) -> f64 {
        let white = level(&self.info.white_level, channel);
        if self.pixels.are_light() {
            self.black(channel) + number * (white - self.black(channel))
        } else {
            number
        }
    }

    /// Converts a number of the file to that of the picture's pixels.
    fn number(&self, channel: usize, stored: f64) -> f64 {
        let white = level(&self.info.white_level, channel);
        if self.pixels.are_light() {
            (stored - self.black(channel)) / (white - self.black(channel))
        } else {
            stored
        }
    }
}

/// The level of a channel, from one for all or one for each.
fn level(levels: &[f64], channel: usize) -> f64 {
    levels.get(channel).or(levels.last()).copied().unwrap_or_default()
}

/// True if several channels have the same numbers, of which there are several.
fn are_alike(channels: &[Sampled]) -> bool {
    let [first, others @ ..] = channels else { return false };
    let varies = first.sorted.first() != first.sorted.last();
    varies && !others.is_empty() && others.iter().all(|other| other.runs == first.runs)
}
