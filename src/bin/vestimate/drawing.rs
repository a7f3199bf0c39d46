//! `--plot`: the first samples, as many as one drawing holds.

use std::path::Path;

use vfold::Result;
use vfold::colorimetry::Observer;
use vfold::plot::multiples::MULTIPLES_MAX;
use vfold::plot::sheet::Sheet;
use vfold::plot::sheets;
use vfold::scene::sheet;
use vfold::spectrum::{Spectrum, illuminant};
use vfold::stream::{Record, Scene, Scenes};

/// What is drawn of a stream.
pub struct Drawing<'a> {
    path: &'a Path,
    daylight: Spectrum,
    scenes: Scenes<Scene>,
    sheets: Vec<Sheet>,
    samples: usize,
}

impl<'a> Drawing<'a> {
    pub fn new(path: &'a Path) -> Result<Self> {
        Ok(Self {
            path,
            daylight: illuminant("D65")?,
            scenes: Scenes::default(),
            sheets: Vec::new(),
            samples: 0,
        })
    }

    /// Takes a record.
    pub fn add(&mut self, record: &Record) -> Result<()> {
        match record {
            Record::Scene(scene) => self.scenes.enter(scene, scene.clone()),
            Record::Sample(sample) => {
                self.samples += 1;
                // of those that have no scene nothing was estimated
                if let Ok(Some(scene)) = self.scenes.of(sample)
                    && self.sheets.len() < MULTIPLES_MAX
                {
                    self.sheets.extend(sheet(sample, scene, &self.daylight, Observer::Cie1964_10deg)?);
                }
            }
            Record::Other(_) => {}
        }
        Ok(())
    }

    pub fn write(&self) -> Result<()> {
        sheets::draw(self.path, &self.sheets, self.samples)
    }
}
