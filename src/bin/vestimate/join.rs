//! `--join`: photographs of one sheet, estimated jointly.

use std::cell::RefCell;
use std::str::FromStr;

use vfold::error::counted;
use vfold::estimate::Exposure;
use vfold::estimate::measured::Measured;
use vfold::estimate::measurement::{Facets, Measurement, Photographed, of_one_sheet};
use vfold::estimate::photograph::Parts;
use vfold::files::composed;
use vfold::forward::FacetValues;
use vfold::scene::photographed;
use vfold::stream::{Kept, Member, Reader, Record, Sample, Together, pipe_together};
use vfold::{Error, Result};

use super::Args;
use super::context::Context;
use super::estimator::{Estimator, Made};

/// How records identify their sheet.
#[derive(Clone, Debug)]
pub enum Join {
    /// By the id without its suffix.
    Id,
    /// By a field.
    Field(String),
    /// By a list of ids, in the form for comparison.
    Ids(Vec<String>),
}

impl FromStr for Join {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        if text.is_empty() {
            return Err("write a field, or ids separated by commas".to_owned());
        }
        let ids: Vec<String> = text.split(',').map(composed).collect();
        Ok(match text {
            "id" => Self::Id,
            _ if ids.len() > 1 => Self::Ids(ids),
            _ => Self::Field(text.to_owned()),
        })
    }
}

impl Join {
    /// The sheet of a sample; none if the sample stands alone.
    ///
    /// # Errors
    /// A sample that does not name its sheet where required.
    pub fn sheet(&self, sample: &Sample) -> Result<Option<String>> {
        let id = composed(&sample.id());
        match self {
            Self::Id => {
                let sheet = id.rsplit_once(['-', '_']).map_or(id.as_str(), |(sheet, _)| sheet);
                Ok(Some(sheet.to_owned()))
            }
            Self::Field(field) => match sample.fields.text_at(field)? {
                Some(sheet) => Ok(Some(sheet)),
                None => Err(Error::field(field, format!("missing in {id}, where --join needs it"))),
            },
            Self::Ids(ids) => Ok(ids.contains(&id).then(|| ids.join(","))),
        }
    }
}

/// Photographs are estimated jointly as those of a real sheet, under a prior.
///
/// # Errors
/// [`Error::Usage`] if flags request anything else.
pub fn check(args: &Args) -> Result<()> {
    if !args.has_prior() {
        let problem = "photographs are estimated together only with a prior";
        return Err(Error::usage("--join", problem, "leave --prior and --method out, or name spectra"));
    }
    if args.exposure == Some(Exposure::Sum) {
        let problem = "with --join each photograph has its own exposure";
        return Err(Error::usage("--exposure", problem, "leave it out, or give 'free'"));
    }
    if args.planning.plan && !matches!(args.join, Some(Join::Id)) {
        let problem = "--plan joins the first scene with each of the others";
        return Err(Error::usage("--join", problem, "give --join without a value"));
    }
    Ok(())
}

/// Passes all records of `reader` through the estimator, photographs of one sheet jointly.
pub fn run(
    join: &Join,
    reader: &mut Reader,
    estimator: &Estimator,
    kept: Kept,
    done: impl FnMut(Record, Option<Made>) -> Result<()>,
) -> Result<()> {
    let named = RefCell::new(match join {
        Join::Ids(ids) => ids.clone(),
        Join::Id | Join::Field(_) => Vec::new(),
    });
    let sheet = |sample: &Sample| {
        named.borrow_mut().retain(|id| *id != composed(&sample.id()));
        join.sheet(sample)
    };
    pipe_together(reader, estimator, kept, sheet, done)?;
    match named.into_inner().as_slice() {
        [] => Ok(()),
        [id, ..] => Err(Error::usage(
            "--join",
            format!("no record has the id {id}"),
            "write the ids as in the records",
        )),
    }
}

/// Photographs of one sheet must share the wavelengths of its spectrum.
///
/// # Errors
/// [`Error::Field`] if they do not.
pub fn check_wavelengths(one: &Context, other: &Context) -> Result<()> {
    if one.inference.wavelengths_nm == other.inference.wavelengths_nm {
        return Ok(());
    }
    let problem = "photographs of one sheet have different wavelengths; use the same for all scenes";
    Err(Error::field("wavelengths_nm", problem))
}

/// Facets, their standard deviations, and the photograph in which they were measured.
type Taken = (FacetValues, FacetValues, Photographed);

/// A photograph that is estimated jointly: its model's parts, and the rest.
type Picture = (Parts, Taken);

impl Estimator<'_> {
    /// Prepares a photograph that is estimated jointly.
    ///
    /// # Errors
    /// [`Error::Field`] if the sample is not a photograph of a fold.
    fn picture(&self, context: &Context, sample: &Sample) -> Result<Picture> {
        let alone = |why: String| {
            let problem = format!("{}: {why}; only photographs of folds are estimated together", sample.id());
            Error::field("id", problem)
        };
        let fold = context.fold.as_deref().ok_or_else(|| alone("the scene is not a fold".to_owned()))?;
        let rgb = sample.facet_rgb()?;
        let sd = self.asked.noise(sample)?.deviations(context.inference.model.facets(), &rgb)?;
        let (rgb, shadows) = fold.out_of_shadows(&rgb, &sd);
        let measured = Measured { rgb: &rgb, sd: &sd };
        let mut photograph =
            photographed(Some(fold), sample, (&measured, shadows), self.asked.exposure_of(sample)?)?;
        match photograph.parts.take() {
            Some(Ok(parts)) => Ok((parts, (rgb, sd, photograph))),
            Some(Err(why)) => Err(alone(why.to_string())),
            None => Err(alone("its exposure is normalised by sums".to_owned())),
        }
    }
}

impl Together for Estimator<'_> {
    fn samples(&self, members: &mut [Member<Context>]) -> Result<Vec<Made>> {
        let pictures: Vec<Picture> =
            members.iter().map(|one| self.picture(&one.context, &one.sample)).collect::<Result<_>>()?;
        let first = &members.first().ok_or_else(|| Error::Numeric("no photograph".to_owned()))?.context;
        members.iter().try_for_each(|other| check_wavelengths(first, &other.context))?;
        let ids: Vec<String> = members.iter().map(|one| one.sample.id()).collect();
        let (parts, pictures): (Vec<Parts>, Vec<_>) = pictures.into_iter().unzip();
        let sheet = of_one_sheet(&parts, &ids, self.prior_of(first)?)?;
        let how =
            format!("prior {}, with {} of the sheet", self.args().prior(), counted(ids.len(), "photograph"));
        let estimates = members.iter_mut().zip(pictures).zip(sheet.photographs);
        let joined = |((one, (rgb, sd, photograph)), estimate): ((&mut Member<Context>, Taken), _)| {
            let facets = Facets {
                measured: &Measured { rgb: &rgb, sd: &sd },
                exposure: self.asked.exposure_of(&one.sample)?,
                photograph: Some(&photograph),
            };
            let Measurement { estimate, verdict, .. } = one.context.inference.share(&facets, estimate);
            let noise = self.asked.noise(&one.sample)?;
            self.finish(&one.context, &mut one.sample, &noise, (&estimate, Some(&verdict)), &how, &ids)
        };
        estimates.map(joined).collect()
    }

    fn are_made(&self, together: &[Sample]) -> bool {
        let ids: Vec<String> = together.iter().map(Sample::id).collect();
        let joined = |one: &Sample| one.estimate().ok().flatten().map(|estimate| estimate.joined);
        match together {
            // what failed alone fails again
            [one] => joined(one).is_none_or(|others| others.is_empty()),
            _ => together.iter().all(|one| joined(one).as_ref() == Some(&ids)),
        }
    }
}
