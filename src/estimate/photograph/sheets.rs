//! Kinds of sheets: how one that is not Lambertian departs from one that is, of the same albedo.

use super::conditions::Conditions;
use super::parts::Radiance;
use crate::estimate::unknowns::Unknown;

/// How a sheet departs from a Lambertian one.
#[derive(Clone, Debug)]
pub struct Departure {
    /// What its facets have more, at the nodes of albedo.
    pub radiance: Radiance,
    /// Its 45:0 reflectance is the first times its albedo, plus the second.
    pub reflectance: [f64; 2],
}

impl Departure {
    fn none(like: &Radiance) -> Self {
        Self { radiance: Radiance::zeros(like.nrows(), like.ncols()), reflectance: [1.0, 0.0] }
    }

    /// What it has more than another.
    #[must_use]
    pub fn less(&self, other: &Self) -> Self {
        let mut difference = self.clone();
        difference.add(-1.0, other, [0.0; 2]);
        difference
    }

    /// Adds a share of another, the reflectance of which counts from `reference`.
    pub fn add(&mut self, share: f64, other: &Self, reference: [f64; 2]) {
        if share != 0.0 {
            self.radiance.zip_apply(&other.radiance, |sum, one| *sum += share * one);
            let departed = other.reflectance.iter().zip(&reference);
            for (sum, (other, reference)) in self.reflectance.iter_mut().zip(departed) {
                *sum += share * (other - reference);
            }
        }
    }
}

/// Where a grid of families is known: strength and roughness of the surface, roughness of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FamilyNodes {
    /// Strengths of the surface's reflection, the first of them 0.
    pub gloss: [f64; 3],
    /// Its roughnesses.
    pub gloss_roughness: [f64; 3],
    /// Roughnesses of the body, degrees.
    pub body_roughness_deg: [f64; 3],
}

/// The nodes that are used.
pub const FAMILY_NODES: FamilyNodes = FamilyNodes {
    gloss: [0.0, 0.4, 1.0],
    gloss_roughness: [0.28, 0.42, 0.65],
    body_roughness_deg: [0.0, 12.0, 25.0],
};

/// Sizes of fuzz at which it is known, on the family in the middle of [`FAMILY_NODES`].
pub const FUZZ: [f64; 2] = [0.4, 1.0];
/// How far a sheet is from the mean of those that were measured, in standard deviations of these: more than one, as they are few.
const MEASURED_VARIATION: f64 = 1.4;
/// How far sheets of a family vary beyond its numbers, and matt ones from being that, in the same unit.
const FAMILY_VARIATION: f64 = 0.4;
const MATT_VARIATION: f64 = 0.2;

/// What is known of how sheets reflect.
#[derive(Clone, Debug)]
pub struct Sheets {
    /// Sheets with a body of Oren and Nayar's and a surface of microfacets, over [`FAMILY_NODES`]: strength, roughness of the surface,
    /// roughness of the body, the last fastest.
    pub families: Vec<Departure>,
    /// What [`FUZZ`] changes.
    pub fuzz: [Departure; 2],
    /// The mean of measured sheets.
    pub measured: Departure,
    /// How measured sheets differ, in units of a standard deviation: differences of departures.
    pub variations: Vec<Departure>,
    /// What facets do not tell of measured sheets.
    pub instrument: Instrument,
}

/// By how much more or less an instrument of 45:0 says of a sheet than sheets that send the same to the camera: standard deviations relative
/// to the albedo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instrument {
    /// In all wavebands alike.
    pub shared: f64,
    /// In each waveband for itself, smooth over the wavelengths.
    pub own: f64,
}

/// The kind that a sheet is taken to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Perfectly matt, or nearly so.
    Matt,
    /// A family: its numbers are among the conditions.
    Family,
    /// Like those that were measured.
    Measured,
}

impl Kind {
    /// Standard deviation of its variations, that of measured sheets from their mean being 1.
    fn variation(self) -> f64 {
        match self {
            Self::Measured => MEASURED_VARIATION,
            Self::Matt => MATT_VARIATION,
            Self::Family => FAMILY_VARIATION,
        }
    }

    /// Whether an unknown makes a difference to sheets of this kind: the numbers of a family make none to others.
    #[must_use]
    pub fn has(self, unknown: &Unknown) -> bool {
        match self {
            Self::Family => true,
            Self::Matt | Self::Measured => !unknown.is_of_sheet(),
        }
    }
}

impl Sheets {
    /// Numbers by which sheets of a kind vary: those of which the facets speak, then what an instrument says beyond them.
    #[must_use]
    pub fn variation_count(&self) -> usize {
        self.variations.len() + 1
    }

    /// What facets have more, at the nodes of albedo, for each of the variations of which they speak.
    pub fn by_variation(&self, kind: Kind) -> impl Iterator<Item = Radiance> + '_ {
        self.variations.iter().map(move |own| kind.variation() * &own.radiance)
    }

    /// How a sheet of a kind departs from a Lambertian one, its variations having these sizes.
    #[must_use]
    pub fn departure(&self, kind: Kind, conditions: &Conditions, variations: &[f64]) -> Departure {
        let mut sum = match kind {
            Kind::Measured => {
                let mut mean = self.measured.clone();
                mean.reflectance[0] += self.instrument.shared * variations.last().copied().unwrap_or(0.0);
                mean
            }
            // of these two the formula tells what an instrument says
            Kind::Matt => Departure::none(&self.measured.radiance),
            Kind::Family => self.family(conditions),
        };
        for (own, size) in self.variations.iter().zip(variations) {
            sum.add(kind.variation() * size, own, [0.0, 0.0]);
        }
        sum
    }

    fn family(&self, conditions: &Conditions) -> Departure {
        let FamilyNodes { gloss, gloss_roughness, body_roughness_deg } = FAMILY_NODES;
        let shares = [
            lagrange(gloss, conditions.gloss),
            lagrange(gloss_roughness, conditions.gloss_roughness),
            lagrange(body_roughness_deg, conditions.body_roughness_deg),
        ];
        let mut sum = Departure::none(&self.families[0].radiance);
        for (n, departure) in self.families.iter().enumerate() {
            let share = shares[0][n / 9] * shares[1][n / 3 % 3] * shares[2][n % 3];
            sum.add(share, departure, [1.0, 0.0]);
        }
        let ([a, b], fuzz) = (FUZZ, conditions.fuzz);
        sum.add(fuzz * (fuzz - b) / (a * (a - b)), &self.fuzz[0], [0.0, 0.0]);
        sum.add(fuzz * (fuzz - a) / (b * (b - a)), &self.fuzz[1], [0.0, 0.0]);
        sum
    }
}

/// Shares of three nodes at `x`.
fn lagrange(nodes: [f64; 3], x: f64) -> [f64; 3] {
    [0, 1, 2].map(|at| {
        let [own, a, b] = [0, 1, 2].map(|n| nodes[(at + n) % 3]);
        (x - a) * (x - b) / ((own - a) * (own - b))
    })
}
