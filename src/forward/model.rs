//! Facet RGB of a fold as a linear combination of a few functions of reflectance.
//!
//! Every facet's radiance is a sum over the poles of the response; the poles and what the reflectance makes of them are
//! common to all facets: eqs. (33) to (35) with the poles in place of all eigenvalues. So the spectrum is integrated
//! once a pole and channel, not once a facet and channel.

use nalgebra::DMatrix;

use crate::camera::CameraResponse;
use crate::geometry::Light;
use crate::response::{ModeLight, Modes, Response};

/// The lights of a scene as the camera responds to them.
#[derive(Clone, Debug)]
pub struct Lighting {
    /// Where the sun stands and how much sky there is.
    pub light: Light,
    /// Response of the camera to the sun.
    pub sun: CameraResponse,
    /// Response to the sky, scaled to 1 in the sun's reference channel; needed only where the light has a sky.
    pub sky: CameraResponse,
}

/// Facet RGB of a fold under known light, for any reflectance of its panels.
#[derive(Clone, Debug)]
pub struct FacetModel {
    poles: Vec<f64>,
    panels: Panels,
    sources: Vec<Source>,
}

/// Whether both panels are of one sheet.
#[derive(Clone, Debug)]
enum Panels {
    /// One sheet, lit unevenly (odd modes excited) or evenly.
    One { odd: bool },
    /// Panel 0 is the sheet, panel 1 a card of known reflectance a waveband.
    Card(Vec<f64>),
}

/// One light: how much of each term every facet takes, and how the camera sees it.
#[derive(Clone, Debug)]
pub struct Source {
    /// Facet by term.
    pub facets: DMatrix<f64>,
    /// The camera's response to this light.
    pub camera: CameraResponse,
}

impl FacetModel {
    /// A fold of one sheet.
    #[must_use]
    pub fn one_sheet(response: &Response, lighting: &Lighting) -> Self {
        let [e0, e1] = lighting.light.panel_irradiance();
        let even = matches!(response.modes(), Modes::Shared(_)) && e0.total_cmp(&e1).is_eq();
        Self::new(response, lighting, Panels::One { odd: !even })
    }

    /// A fold of a sheet (panel 0) and a card (panel 1) whose reflectance is known on the scene's wavelengths.
    #[must_use]
    pub fn with_card(response: &Response, lighting: &Lighting, card: Vec<f64>) -> Self {
        Self::new(response, lighting, Panels::Card(card))
    }

    fn new(response: &Response, lighting: &Lighting, panels: Panels) -> Self {
        let mut model = Self { poles: response.poles(), panels, sources: Vec::new() };
        model.add_source(response, &lighting.sun, ModeLight::Sun(lighting.light.panel_irradiance()));
        if lighting.light.sky() > 0.0 {
            model.add_source(response, &lighting.sky, ModeLight::Sky(lighting.light.sky()));
        }
        model
    }

    fn add_source(&mut self, response: &Response, camera: &CameraResponse, light: ModeLight) {
        let count = response.facets();
        let mut facets = DMatrix::zeros(2 * count, self.terms());
        let poles = self.poles.len();
        for facet in 0..2 * count {
            let panel = facet / count;
            for (k, mode) in response.excitations(panel, facet % count, light).iter().enumerate() {
                match self.panels {
                    Panels::One { odd } => {
                        facets[(facet, k)] = 0.5 * (mode.own + mode.other);
                        if odd {
                            facets[(facet, poles + k)] = 0.5 * (mode.own - mode.other);
                        }
                    }
                    Panels::Card(_) => {
                        facets[(facet, 2 * panel * poles + k)] = mode.own;
                        facets[(facet, poles + k)] = mode.other;
                    }
                }
            }
        }
        self.sources.push(Source { facets, camera: camera.clone() });
    }

    /// Number of terms: functions of reflectance that all facets combine.
    #[must_use]
    pub fn terms(&self) -> usize {
        self.poles.len()
            * match self.panels {
                Panels::One { odd: false } => 1,
                Panels::One { odd: true } => 2,
                Panels::Card(_) => 3,
            }
    }

    /// Number of wavebands.
    #[must_use]
    pub fn bands(&self) -> usize {
        self.sources[0].camera.channel(0).len()
    }

    /// The lights, each with what facets take of the terms.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// The terms and their first `N − 1` derivatives by reflectance, for a spectrum: term by waveband, `N` from 1 to 3.
    ///
    /// One sheet: `r/(1 − rg)`, then `r/(1 + rg)` where panels are lit unevenly. With a card c: `r/d`, `rcg/d`, `c/d`,
    /// `d = 1 − rcg²`. Never `1/r`: black is a legal reflectance.
    #[must_use]
    pub fn terms_of<const N: usize>(&self, reflectance: &[f64]) -> [DMatrix<f64>; N] {
        let (terms, poles) = (self.terms(), self.poles.len());
        let mut all = [(); N].map(|()| DMatrix::zeros(terms, reflectance.len()));
        for (band, r) in reflectance.iter().enumerate() {
            for (n, family) in self.families(band).iter().enumerate() {
                let start = band * terms + n * poles;
                let mut targets =
                    all.each_mut().map(|matrix| &mut matrix.as_mut_slice()[start..start + poles]);
                for (k, g) in self.poles.iter().enumerate() {
                    let at = family.at(*r, *g);
                    targets.iter_mut().zip(at).for_each(|(target, value)| target[k] = value);
                }
            }
        }
        all
    }

    /// The families of terms in a waveband.
    fn families(&self, band: usize) -> Families {
        const EVEN: Family = Family { offset: 0.0, a: [1.0, 0.0, 0.0], b: [1.0, 0.0] };
        const ODD: Family = Family { offset: 0.0, a: [1.0, 0.0, 0.0], b: [-1.0, 0.0] };
        match &self.panels {
            Panels::One { odd } => Families { all: [EVEN, ODD, ODD], count: 1 + usize::from(*odd) },
            Panels::Card(card) => {
                let c = card[band];
                let family = |offset, a| Family { offset, a, b: [0.0, c] };
                // The last is c/d = c + c²g²·r/d.
                let all =
                    [family(0.0, [1.0, 0.0, 0.0]), family(0.0, [0.0, c, 0.0]), family(c, [0.0, 0.0, c * c])];
                Families { all, count: 3 }
            }
        }
    }

    /// RGB of every facet at exposure 1: facet by channel, facet order panel, row, column.
    ///
    /// # Source
    /// Deeb et al., eq. (24), for the uniform sheet eq. (33).
    #[must_use]
    pub fn facet_rgb(&self, reflectance: &[f64]) -> DMatrix<f64> {
        let [terms] = self.terms_of(reflectance);
        let of_source = |source: &Source| {
            let camera = &source.camera;
            let weights =
                DMatrix::from_fn(reflectance.len(), camera.channels(), |band, c| camera.channel(c)[band]);
            &source.facets * (&terms * weights)
        };
        self.sources.iter().map(of_source).sum()
    }
}

/// Up to three families of terms.
struct Families {
    all: [Family; 3],
    count: usize,
}

impl Families {
    fn iter(&self) -> impl Iterator<Item = &Family> {
        self.all[..self.count].iter()
    }
}

/// `offset + a·r/(1 − b·r)`, with a and b polynomials of the pole g: `a₀ + a₁g + a₂g²` and `b₁g + b₂g²`.
struct Family {
    offset: f64,
    a: [f64; 3],
    b: [f64; 2],
}

impl Family {
    /// Value, first and second derivative at reflectance `r` for the pole `g`.
    #[inline]
    fn at(&self, r: f64, g: f64) -> [f64; 3] {
        let a = self.a[0] + g * (self.a[1] + g * self.a[2]);
        let b = g * (self.b[0] + g * self.b[1]);
        let rest = 1.0 / (1.0 - b * r);
        let slope = a * rest * rest;
        [self.offset + a * r * rest, slope, 2.0 * b * slope * rest]
    }
}
