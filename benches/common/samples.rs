//! Samples of a stream, ready to be estimated in process as `vestimate` does.

use vfold::estimate::Exposure;
use vfold::estimate::data::FacetData;
use vfold::estimate::measured::Measured;
use vfold::estimate::measurement::CUTOFF;
use vfold::estimate::noise::{deviations, unexplained};
use vfold::estimate::unknowns::SceneModel;
use vfold::forward::FacetValues;
use vfold::paper::smooth;
use vfold::scene::Setting;
use vfold::spectrum::{Outside, WavelengthGrid, reflectances};
use vfold::stream::{Reader, Record, Sample};
use vfold::{Error, Result};

/// A scene and its samples.
pub struct Batch {
    /// What is known of the scene.
    pub scene: SceneModel,
    /// Its wavelengths.
    pub grid: WavelengthGrid,
    /// Its samples.
    pub shots: Vec<Shot>,
}

/// The facets of a sheet that is known.
#[derive(Clone)]
pub struct Shot {
    rgb: FacetValues,
    sd: FacetValues,
    /// Value of white facing the sun.
    pub exposure: Exposure,
    /// Reflectance a waveband.
    pub truth: Vec<f64>,
}

impl Batch {
    /// Reads one scene and all of its samples from a file, or from standard input for `-`.
    pub fn read(path: &str) -> Result<Self> {
        let mut reader = Reader::open(path)?;
        let Some(Record::Scene(scene)) = reader.read()? else {
            return Err(Error::Numeric("no scene; pipe vkernel | vforward into the benchmark".to_owned()));
        };
        let mut batch = Self {
            scene: SceneModel::known(Setting::of(&scene)?.model()?),
            grid: scene.grid()?,
            shots: Vec::new(),
        };
        while let Some(record) = reader.read()? {
            if let Record::Sample(sample) = record {
                batch.shots.push(Shot::new(&batch.scene, &sample)?);
            }
        }
        Ok(batch)
    }

    /// The Munsell chips on the scene's wavelengths.
    pub fn chips(&self) -> Result<Vec<Vec<f64>>> {
        reflectances("munsell")?.iter().map(|chip| chip.on(&self.grid, Outside::Refuse)).collect()
    }
}

impl Shot {
    fn new(scene: &SceneModel, sample: &Sample) -> Result<Self> {
        let rgb = sample.facet_rgb()?;
        let sd = match sample.facet_sd()? {
            Some(said) => deviations(&rgb, |[facet, channel]| said.get(facet, channel).unwrap_or(0.0), 0.0),
            None => {
                let noise = unexplained(scene.facets(), &rgb);
                deviations(&rgb, |[_, channel]| noise[channel], 0.0)
            }
        };
        let exposure = sample.exposure()?.map_or(Exposure::Free, Exposure::Known);
        let truth = sample.truth()?.ok_or_else(|| Error::field("truth", "missing; vforward adds it"))?;
        Ok(Self { rgb, sd, exposure, truth: truth.reflectance })
    }

    /// The facets and their noise.
    pub fn measured(&self) -> Measured<'_> {
        Measured { rgb: &self.rgb, sd: &self.sd }
    }

    /// The same facets, thought to have `times` their noise.
    pub fn with_noise(mut self, times: f64) -> Self {
        self.sd = self.sd.map(|_, sd| times * sd);
        self
    }

    /// The same facets, white facing the sun being of another value.
    pub fn with_exposure(mut self, exposure: Exposure) -> Self {
        self.exposure = exposure;
        self
    }

    /// The facets in units of their noise.
    pub fn data<'a>(&'a self, scene: &'a SceneModel) -> Result<FacetData<'a>> {
        FacetData::new(scene, &self.measured(), self.exposure, CUTOFF)
    }

    /// The facets, white being 1, as the paper's objective has them.
    pub fn unweighted<'a>(&'a self, scene: &'a SceneModel) -> Result<FacetData<'a>> {
        let ones = self.rgb.map(|_, _| 1.0);
        FacetData::new(scene, &Measured { rgb: &self.rgb, sd: &ones }, self.exposure, smooth::CUTOFF)
    }
}
