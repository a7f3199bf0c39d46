//! `--known-fold`: a fold of a sheet with known reflectance, in addition to those that are estimated.

use vfold::estimate::Exposure;
use vfold::estimate::data::FacetData;
use vfold::estimate::light::{Candidate, KnownSheet, Others, Shown};
use vfold::estimate::measured::Measured;
use vfold::estimate::measurement::CUTOFF;
use vfold::estimate::photograph::Parts;
use vfold::scene::{FoldSetting, PhotographedFold, Picture, Setting};
use vfold::spectrum::{Outside, Spectrum};
use vfold::stream::{Optics, Reader, Record, Sample, Scene};
use vfold::{Error, Result};

use super::Args;
use super::asked::Asked;
use super::context::SceneMethod;
use super::latest::Latest;

const FLAG: &str = "--known-fold";

/// The fold from its record.
pub struct KnownFold {
    path: String,
    scene: Scene,
    sample: Sample,
    spectrum: Spectrum,
    /// What it shows of a light.
    known: Latest<Taken, Known>,
}

/// Light and camera of samples, and whether the light is assumed daylight, or unknown.
type Taken = (Optics, [bool; 2]);

/// Candidates for the light, and other inferred knowledge on it.
type Known = (Vec<Candidate>, Option<Shown>);

/// Parses the value of the flag.
pub fn file_and_spec(text: &str) -> std::result::Result<(String, String), String> {
    match text.split_once('=') {
        Some((file, spec)) if !file.is_empty() && !spec.is_empty() => Ok((file.to_owned(), spec.to_owned())),
        _ => Err("write FILE=SPEC, such as card.ndjson=cc24:white".to_owned()),
    }
}

impl KnownFold {
    /// The fold named by the flags, if any.
    ///
    /// # Errors
    /// A file that does not exist or does not contain exactly one sample, or a SPEC that does not name a
    /// single reflectance; [`Error::Usage`] with a method that weighs no lights.
    pub fn of(args: &Args) -> Result<Option<Self>> {
        let Some((path, spec)) = &args.known_fold else { return Ok(None) };
        if !args.has_prior() {
            let problem = "a known fold needs a prior";
            return Err(Error::usage(FLAG, problem, "leave --prior and --method out, or name spectra"));
        }
        let spectrum = args.common.one_reflectance(FLAG, spec)?;
        let mut reader = Reader::open(path)?;
        let (mut scene, mut found) = (None, None);
        while let Some(record) = reader.read()? {
            match record {
                Record::Scene(one) => scene = Some(one),
                Record::Sample(sample) => {
                    sample.facet_rgb().map_err(|e| reader.at(e))?;
                    let is_second = found.replace((scene.clone(), sample)).is_some();
                    if is_second {
                        let problem = "a second sample; keep only that of the known sheet";
                        return Err(reader.at(Error::field("kind", problem)));
                    }
                }
                Record::Other(_) => {}
            }
        }
        let Some((Some(scene), sample)) = found else {
            let problem = "no scene followed by a sample; give the output of vforward or vextract";
            return Err(reader.at(Error::field("kind", problem)));
        };
        if let Some(problem) = sample.error().map_err(|e| reader.at(e))? {
            return Err(reader.at(Error::field("error", problem)));
        }
        Ok(Some(Self { path: path.clone(), scene, sample, spectrum, known: Latest::default() }))
    }

    /// Its evidence on the light of the samples' scene, which is stated in an assumed light if it is one of
    /// `lights`; returns these as it leaves them.
    pub fn shown(
        &self,
        asked: &Asked,
        (samples, method): (&Scene, &SceneMethod),
        (lights, others): (Vec<Candidate>, Option<&Others>),
    ) -> Result<Known> {
        let taken = (samples.optics()?, [samples.is_daylight_assumed()?, !lights.is_empty()]);
        self.known.get(taken, |taken| self.shown_anew(asked, method, taken, (lights, others)))
    }

    fn shown_anew(
        &self,
        asked: &Asked,
        method: &SceneMethod,
        taken: &Taken,
        (lights, others): (Vec<Candidate>, Option<&Others>),
    ) -> Result<Known> {
        let lit = self.in_light_of(taken)?;
        let (optics, _) = taken;
        let reflectance = self.spectrum.on(&optics.grid, Outside::Refuse)?;
        let sheet = KnownSheet::new(optics.grid.wavelengths_nm(), &reflectance)?;
        // in a stated light, any daylight being one, its colour alone shows nothing
        let is_flat_photograph = self.is_photograph()
            && !lights.is_empty()
            && FoldSetting::of(&lit).is_ok_and(|setting| setting.fold.is_flat());
        if let SceneMethod::Map(prior) = method
            && self.is_photograph()
            && !is_flat_photograph
        {
            let parts = self.parts(asked, &lit)?;
            let shown = sheet.in_photograph(&parts, &lights, prior)?;
            return Ok((lights, Some(shown)));
        }
        let model = Setting::of(&lit)
            .and_then(|setting| setting.model_to_fit(&asked.fit))
            .map_err(|e| self.at(&e))?;
        let rgb = self.sample.facet_rgb()?;
        let sd = if is_flat_photograph {
            KnownSheet::flat_deviations(&rgb)
        } else {
            asked.noise(&self.sample)?.deviations(model.facets(), &rgb).map_err(|e| self.at(&e))?
        };
        let exposure = asked.exposure_of(&self.sample)?;
        let data = FacetData::new(&model, &Measured { rgb: &rgb, sd: &sd }, exposure, CUTOFF)
            .map_err(|e| self.at(&e))?;
        if lights.is_empty() {
            return Ok((lights, Some(sheet.in_stated_light(&data, others)?)));
        }
        let (mut lights, shown) = sheet.weigh(&data, lights)?;
        if is_flat_photograph {
            // another picture has another exposure
            lights.iter_mut().for_each(|light| light.exposure = None);
        }
        Ok((lights, Some(shown)))
    }

    /// Whether it was photographed.
    pub fn is_photograph(&self) -> bool {
        self.sample.is_photograph()
    }

    /// The parts of its photograph's model, with its scene `lit`.
    fn parts(&self, asked: &Asked, lit: &Scene) -> Result<Parts> {
        let fold = FoldSetting::of(lit).map_err(|e| self.at(&e))?;
        let rgb = self.sample.facet_rgb()?;
        let sd = asked
            .noise(&self.sample)?
            .deviations(&fold.model().map_err(|e| self.at(&e))?, &rgb)
            .map_err(|e| self.at(&e))?;
        let (rgb, _) = fold.out_of_shadows(&rgb, &sd);
        let measured = Measured { rgb: &rgb, sd: &sd };
        let exposure = asked.exposure_of(&self.sample)?.known();
        let picture = Picture::of(&self.sample, &measured, exposure).map_err(|e| self.at(&e))?;
        let parts = PhotographedFold::of(&fold).parts(&picture).map_err(|e| self.at(&e))?;
        parts.map_err(|why| {
            wrong(&self.path, &why.to_string(), "give a fold whose photograph shows the light")
        })
    }

    /// Its scene in the light of samples.
    ///
    /// # Errors
    /// [`Error::Usage`] if it was taken by another camera, in another light or on other wavelengths.
    fn in_light_of(&self, (samples, [is_daylight_assumed, is_unknown]): &Taken) -> Result<Scene> {
        let camera = self.scene.camera().map_err(|e| self.at(&e))?;
        let grid = self.scene.grid().map_err(|e| self.at(&e))?;
        if grid != samples.grid {
            return Err(self.other("wavelengths", "give both scenes the same"));
        }
        if camera.sensitivities != samples.camera.sensitivities {
            let what = format!("its camera is {}, that of the samples {}", camera.name, samples.camera.name);
            return Err(wrong(&self.path, &what, "use one camera for both"));
        }
        let is_known_unlit = self.scene.is_light_unknown().map_err(|e| self.at(&e))?;
        if !is_unknown && !is_known_unlit {
            let own = self.scene.illuminants().map_err(|e| self.at(&e))?;
            if !own.iter().map(|one| &one.power).eq(samples.illuminants.iter().map(|one| &one.power)) {
                return Err(self.other("light", "state the same light for both, or leave both unknown"));
            }
        }
        let mut lit = self.scene.clone();
        lit.set_optics(samples)?;
        if *is_daylight_assumed {
            lit.set_daylight_assumed()?;
        }
        Ok(lit)
    }

    /// Refuses a computed sample if this fold was photographed, or the reverse, and one whose exposure is to
    /// be inferred from this fold's, but was different.
    ///
    /// # Errors
    /// [`Error::Field`] if the records show this.
    pub fn check(&self, sample: &Sample, exposure: Exposure) -> Result<()> {
        if sample.is_photograph() != self.is_photograph() {
            let [own, known] = [sample, &self.sample]
                .map(|one| if one.is_photograph() { "photographed" } else { "computed" });
            let problem =
                format!("the sample is {own}, the known fold {known}; photograph both or compute both");
            return Err(Error::field("image", problem));
        }
        if exposure != Exposure::Free || sample.is_photograph() {
            return Ok(());
        }
        match (sample.exposure()?, self.sample.exposure()?) {
            (Some(own), Some(known)) if own.total_cmp(&known).is_ne() => {
                let problem = format!(
                    "{own}, but the known fold's is {known}; give both the same, or leave --exposure out"
                );
                Err(Error::field("exposure", problem))
            }
            _ => Ok(()),
        }
    }

    fn other(&self, what: &str, remedy: &str) -> Error {
        wrong(&self.path, &format!("its scene differs from that of the samples in its {what}"), remedy)
    }

    fn at(&self, error: &Error) -> Error {
        wrong(&self.path, &error.to_string(), "give a fold in the format of vforward and vextract")
    }
}

fn wrong(path: &str, problem: &str, remedy: &str) -> Error {
    Error::usage(FLAG, format!("{path}: {problem}"), remedy)
}
