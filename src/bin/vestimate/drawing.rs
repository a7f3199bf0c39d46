//! `--plot`: the first samples, as many as fit into one drawing.

use std::path::Path;

use vfold::Result;
use vfold::colorimetry::Observer;
use vfold::plot::multiples::MULTIPLES_MAX;
use vfold::plot::sheet::Sheet;
use vfold::plot::sheets;
use vfold::scene::sheet;
use vfold::spectrum::{Spectrum, illuminant};
use vfold::stream::{EstimateRecord, Record, Scene, Scenes};

/// The drawing of a stream.
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

    /// Adds a record, with its estimate if it is a sample that has one.
    pub fn add(&mut self, record: &Record, estimate: Option<&EstimateRecord>) -> Result<()> {
        match record {
            Record::Scene(scene) => self.scenes.enter(scene, scene.clone()),
            Record::Sample(sample) => {
                self.samples += 1;
                // samples without a scene have no estimate
                if let (Ok(Some(scene)), Some(estimate)) = (self.scenes.of(sample), estimate)
                    && self.sheets.len() < MULTIPLES_MAX
                {
                    let observer = Observer::Cie1964_10deg;
                    self.sheets.push(sheet((sample, estimate), scene, &self.daylight, observer)?);
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
