//! `--plot`: the first samples, as many as one drawing holds.

use std::path::Path;

use vfold::Result;
use vfold::colorimetry::Observer;
use vfold::plot::multiples::MULTIPLES_MAX;
use vfold::plot::sheet::Sheet;
use vfold::plot::sheets;
use vfold::scene::sheet;
use vfold::spectrum::{Spectrum, illuminant};
use vfold::stream::{Record, Scene};

/// What is drawn of a stream.
pub struct Drawing<'a> {
    path: &'a Path,
    daylight: Spectrum,
    scene: Option<Scene>,
    sheets: Vec<Sheet>,
    samples: usize,
}

impl<'a> Drawing<'a> {
    pub fn new(path: &'a Path) -> Result<Self> {
        Ok(Self { path, daylight: illuminant("D65")?, scene: None, sheets: Vec::new(), samples: 0 })
    }

    /// Takes a record.
    pub fn add(&mut self, record: &Record) -> Result<()> {
        match (record, &self.scene) {
            (Record::Scene(scene), _) => self.scene = Some(scene.clone()),
            (Record::Sample(sample), Some(scene)) => {
                self.samples += 1;
                if self.sheets.len() < MULTIPLES_MAX {
                    self.sheets.extend(sheet(sample, scene, &self.daylight, Observer::Cie1964_10deg)?);
                }
            }
            _ => {}
        }
        Ok(())
    }

    pub fn write(&self) -> Result<()> {
        sheets::draw(self.path, &self.sheets, self.samples)
    }
}
