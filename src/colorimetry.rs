//! Appearance of a reflectance: XYZ, CIELAB, CIEDE2000, and sRGB for swatches.
//!
//! Paper section 5B scores an estimate by CIEDE2000 for the 10° observer under D65. The crate `colorimetry`
//! provides CIELAB, CIEDE2000 and the sRGB primaries; only the integral over the scene's own grid is computed
//! here.

mod uncertainty;

pub use uncertainty::{Colour, ErrorBars};

use crate::error::{Error, Result};
use crate::spectrum::{Outside, Spectrum, WavelengthGrid};
use colorimetry::lab::CieLab;
use colorimetry::observer;
use colorimetry::rgb::RgbSpace;
use colorimetry::xyz::{RelXYZ, XYZ};
use nalgebra::{Matrix3, Vector3};

/// CIE standard observers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observer {
    /// CIE 1931, 2° field.
    Cie1931_2deg,
    /// CIE 1964, 10° field.
    Cie1964_10deg,
}

impl From<Observer> for observer::Observer {
    fn from(observer: Observer) -> Self {
        match observer {
            Observer::Cie1931_2deg => Self::Cie1931,
            Observer::Cie1964_10deg => Self::Cie1964,
        }
    }
}

/// An observer and an illuminant on one wavelength grid.
///
/// Integrals use the trapezoid rule over the grid's range, and the perfect diffuser has Y = 100 on the same
/// range: the paper's 400..700 nm omits the ends of 360..830 nm, where the observers' responses are
/// negligible.
///
/// # Example
/// ```
/// use vfold::colorimetry::{Colorimeter, Observer};
/// use vfold::spectrum::{WavelengthGrid, illuminant};
/// let grid = WavelengthGrid::default();
/// let d65 = Colorimeter::new(&grid, &illuminant("D65")?, Observer::Cie1964_10deg)?;
/// let [lightness, a, b] = d65.lab(&vec![0.184187; grid.len()]);
/// assert!((lightness - 50.0).abs() < 1e-3 && a.abs() < 1e-9 && b.abs() < 1e-9);
/// # Ok::<(), vfold::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Colorimeter {
    /// X, Y and Z of a unit reflectance in each waveband alone.
    wavebands: Vec<[f64; 3]>,
    white: XYZ,
    to_d65: Matrix3<f64>,
}

impl Colorimeter {
    /// The colorimeter for spectra on `grid`.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if `illuminant` does not cover the grid, [`Error::Numeric`] if one of X, Y, Z is
    /// zero for it, so that there is no white reference.
    pub fn new(grid: &WavelengthGrid, illuminant: &Spectrum, observer: Observer) -> Result<Self> {
        let power = illuminant.on(grid, Outside::Refuse)?;
        let weights_nm = grid.trapezoid_weights_nm();
        let mut wavebands = matching_functions(grid, observer.into());
        for (xyz, (power, weight_nm)) in wavebands.iter_mut().zip(power.iter().zip(&weights_nm)) {
            *xyz = xyz.map(|matching| matching * power * weight_nm);
        }
        let white = sum(wavebands.iter().copied());
        if white.iter().any(|&value| value <= 0.0) {
            let name = illuminant.name();
            return Err(Error::Numeric(format!(
                "illuminant '{name}' on {grid} has no white point (XYZ {white:?}); \
                 choose another illuminant or grid"
            )));
        }
        let scale = 100.0 / white[1];
        wavebands.iter_mut().for_each(|xyz| *xyz = xyz.map(|value| value * scale));
        let white = XYZ::new(white.map(|value| value * scale), observer.into());
        Ok(Self { wavebands, white, to_d65: bradford(white, white.observer().xyz_d65()) })
    }

    /// XYZ of a reflectance on the grid; the perfect diffuser has Y = 100.
    ///
    /// # Panics
    /// If `reflectance` and the grid differ in length.
    #[must_use]
    pub fn xyz(&self, reflectance: &[f64]) -> [f64; 3] {
        assert_eq!(reflectance.len(), self.wavebands.len(), "a reflectance on another grid");
        sum(self.wavebands.iter().zip(reflectance).map(|(xyz, r)| xyz.map(|value| value * r)))
    }

    /// CIELAB L*, a*, b* of a reflectance on the grid, with the perfect diffuser as white.
    ///
    /// # Panics
    /// If `reflectance` and the grid differ in length.
    #[must_use]
    pub fn lab(&self, reflectance: &[f64]) -> [f64; 3] {
        self.lab_of(self.xyz(reflectance))
    }

    /// CIELAB of XYZ under the illuminant.
    fn lab_of(&self, xyz: [f64; 3]) -> [f64; 3] {
        CieLab::from_rxyz(RelXYZ::new(xyz, self.white)).to_array()
    }

    /// CIEDE2000 between two reflectances on the grid.
    ///
    /// # Panics
    /// If a reflectance and the grid differ in length.
    #[must_use]
    pub fn delta_e_2000(&self, a: &[f64], b: &[f64]) -> f64 {
        ciede2000(self.lab(a), self.lab(b))
    }

    /// Special metamerism index for a change of illuminant: CIEDE2000 under `self` between two reflectances,
    /// with `b` corrected by the factors in X, Y and Z that make the two match under `reference`.
    ///
    /// 0 for two reflectances that match under both; otherwise the difference that no correction under one
    /// light can remove.
    ///
    /// # Source
    /// CIE 15:2018, section 9.2; the multiplicative correction is that of A. Brockes, "Vergleich der
    /// Metamerie-Indizes bei Lichtartwechsel", *Die Farbe* 19 (1970), p. 135, and DIN 6172.
    ///
    /// # Panics
    /// If a reflectance and the grid differ in length.
    #[must_use]
    pub fn metamerism_index(&self, reference: &Self, a: &[f64], b: &[f64]) -> f64 {
        let (a_reference, b_reference) = (reference.xyz(a), reference.xyz(b));
        let (a, mut b) = (self.xyz(a), self.xyz(b));
        for (i, b) in b.iter_mut().enumerate() {
            // no factor makes black match
            if b_reference[i] > 0.0 {
                *b *= a_reference[i] / b_reference[i];
            }
        }
        ciede2000(self.lab_of(a), self.lab_of(b))
    }

    /// The reflectance as a colour on screen: sRGB (IEC 61966-2-1) with its transfer curve, each 0..1.
    ///
    /// The perfect diffuser is the screen's white under any illuminant (Bradford adaptation); colours outside
    /// the screen's gamut are clipped.
    ///
    /// # Panics
    /// If `reflectance` and the grid differ in length.
    #[must_use]
    pub fn srgb(&self, reflectance: &[f64]) -> [f64; 3] {
        self.screen(self.xyz(reflectance)).map(encode_srgb)
    }

    /// Linear sRGB of a unit reflectance in each waveband alone: the response of a camera that needs no
    /// colour conversion. Channel by waveband; white gives 1 in each channel.
    #[must_use]
    pub fn screen_weights(&self) -> Vec<Vec<f64>> {
        (0..3).map(|channel| self.wavebands.iter().map(|xyz| self.screen(*xyz)[channel]).collect()).collect()
    }

    /// Linear sRGB of XYZ under the illuminant.
    fn screen(&self, xyz: [f64; 3]) -> [f64; 3] {
        let adapted = self.to_d65 * Vector3::from(xyz);
        XYZ::new(adapted.into(), self.white.observer()).rgb(RgbSpace::SRGB).to_array()
    }
}

/// Encodes linear sRGB, 0..1, for a screen, 0..1 (IEC 61966-2-1); values outside are clipped.
#[must_use]
pub fn encode_srgb(linear: f64) -> f64 {
    RgbSpace::SRGB.gamma().encode(linear.clamp(0.0, 1.0))
}

/// CIEDE2000 between two CIELAB colours (CIE 142-2001; Sharma, Wu and Dalal 2005).
///
/// # Example
/// ```
/// use vfold::colorimetry::ciede2000;
/// let difference = ciede2000([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485]);
/// assert!((difference - 2.0425).abs() < 1e-4);
/// ```
#[must_use]
pub fn ciede2000(lab_a: [f64; 3], lab_b: [f64; 3]) -> f64 {
    // the crate only compares colours with a common white, as these have
    let white = XYZ::new([100.0; 3], observer::Observer::Cie1964);
    CieLab::new(lab_a, white).ciede2000(&CieLab::new(lab_b, white)).unwrap_or(f64::NAN)
}

/// x̄, ȳ, z̄ at the grid's wavelengths; 0 outside the crate's 380..780 nm.
fn matching_functions(grid: &WavelengthGrid, observer: observer::Observer) -> Vec<[f64; 3]> {
    let at = |nm: f64| observer.xyz_at_wavelength(nm as usize).map_or([0.0; 3], |xyz| xyz.to_array());
    let between = |&nm: &f64| {
        let (below, above, share) = (at(nm.floor()), at(nm.ceil()), nm.fract());
        [0, 1, 2].map(|i| below[i] * (1.0 - share) + above[i] * share)
    };
    grid.wavelengths_nm().iter().map(between).collect()
}

fn sum(terms: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    terms.fold([0.0; 3], |[x, y, z], [dx, dy, dz]| [x + dx, y + dy, z + dz])
}

/// Maps XYZ under the white `from` to corresponding XYZ under the white `to` (Lam 1985; CIE 159:2004,
/// Bradford).
fn bradford(from: XYZ, to: XYZ) -> Matrix3<f64> {
    #[rustfmt::skip]
    let cones = Matrix3::new(
        0.8951, 0.2664, -0.1614,
        -0.7502, 1.7135, 0.0367,
        0.0389, -0.0685, 1.0296,
    );
    let [from, to] = [from, to].map(|white| cones * Vector3::from(white.to_array()));
    let gain = Matrix3::from_diagonal(&to.component_div(&from));
    // the matrix is regular; the other branch only satisfies the types
    cones.try_inverse().map_or(Matrix3::identity(), |back| back * gain * cones)
}
