//! Donaldson matrices: the light that a fluorescent sheet returns at each wavelength, for light of each
//! wavelength.

use nalgebra::DMatrix;

use super::{Outside, Spectrum, WavelengthGrid, formats, interpolation::Interpolation};
use crate::error::{Error, Result};

/// Light within this distance of its excitation, nm, counts as reflected: instruments that measure such
/// matrices have bands of 10 nm, in which reflected light leaks into the neighbours.
const REFLECTED_WITHIN_NM: f64 = 10.0;
/// Above the noise of instruments, which reaches 0.006 in four matrices of a Labsphere BFC-450.
const NO_NOISE: f64 = 0.01;

/// The bispectral radiance factors of a sheet: the light leaving it in one waveband for light falling on it
/// in another, where white returns in each waveband the light that it receives there.
///
/// # Source
/// R. Donaldson, "Spectrophotometry of fluorescent pigments", *British Journal of Applied Physics* 5 (1954),
/// p. 210.
#[derive(Clone, Debug, PartialEq)]
pub struct Donaldson {
    /// Reflected light, on the wavelengths of emission.
    reflectance: Spectrum,
    excitation: WavelengthGrid,
    /// Fluorescent light, a spectrum for each wavelength of excitation.
    fluorescence: Vec<Spectrum>,
}

/// Reflection and emission of a fluorescent sheet, on the wavelengths of a scene and on those that excite it.
#[derive(Clone, Debug, PartialEq)]
pub struct Bispectral {
    /// Reflectance, one per waveband of the scene.
    pub reflectance: Vec<f64>,
    /// Emission in the scene's wavebands (rows) for light in the excitation bands (columns), without
    /// reflection.
    pub fluorescence: DMatrix<f64>,
    /// The bands of excitation.
    pub excitation: WavelengthGrid,
    /// Light leaving the sheet in those bands (rows) for light in them (columns), reflection included.
    pub between_bands: DMatrix<f64>,
}

impl Donaldson {
    /// The matrix of `factors`, emission by excitation, for a sheet of this name. Factors within 10 nm of
    /// their excitation are reflection. No light is emitted at wavelengths shorter than the excitation: such
    /// factors are noise and omitted, as are negative ones.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if more is reflected than by white, or if rows and columns are interchanged;
    /// [`Error::Grid`] if wavelengths do not increase.
    ///
    /// # Example
    /// ```
    /// use nalgebra::dmatrix;
    /// use vfold::spectrum::{Donaldson, WavelengthGrid};
    /// let (emission, excitation) =
    ///     (WavelengthGrid::new(vec![400.0, 450.0])?, WavelengthGrid::new(vec![350.0, 400.0, 450.0])?);
    /// let brightened =
    ///     Donaldson::new("cloth", emission.clone(), excitation, &dmatrix![0.0, 0.5, 0.0; 0.2, 0.1, 0.8])?;
    /// let cloth = brightened.on(&emission)?;
    /// assert_eq!(cloth.reflectance, [0.5, 0.8]);
    /// assert_eq!(cloth.fluorescence, dmatrix![0.0, 0.0, 0.0; 0.2, 0.1, 0.0]);
    /// # Ok::<(), vfold::Error>(())
    /// ```
    pub fn new(
        name: &str,
        emission: WavelengthGrid,
        excitation: WavelengthGrid,
        factors: &DMatrix<f64>,
    ) -> Result<Self> {
        let (emission_nm, excitation_nm) = (emission.wavelengths_nm(), excitation.wavelengths_nm());
        let shift_nm = |row: usize, column: usize| emission_nm[row] - excitation_nm[column];
        // the factors for which `is_there` holds, given the shift between their wavelengths
        let part = |is_there: fn(f64) -> bool| {
            DMatrix::from_fn(emission_nm.len(), excitation_nm.len(), |row, column| {
                if is_there(shift_nm(row, column)) { factors[(row, column)].max(0.0) } else { 0.0 }
            })
        };
        let reflected = part(|shift_nm| shift_nm.abs() <= REFLECTED_WITHIN_NM);
        let fluorescence = part(|shift_nm| shift_nm > REFLECTED_WITHIN_NM);
        let below = part(|shift_nm| shift_nm < -REFLECTED_WITHIN_NM).max();
        if below > NO_NOISE && below > fluorescence.max() {
            let problem = "most emission has shorter wavelengths than its excitation";
            return Err(Error::spectrum(name, problem, "write emission in rows, excitation in columns"));
        }
        let reflectance: Vec<f64> = reflected.row_iter().map(|row| row.sum()).collect();
        if let Some(row) = reflectance.iter().position(|reflectance| *reflectance > 1.0) {
            let problem =
                format!("at {} nm the reflectance is {}, above 1", emission_nm[row], reflectance[row]);
            return Err(Error::spectrum(
                name,
                problem,
                "give radiance factors per band, as fractions of white's",
            ));
        }
        let spectrum = |values: Vec<f64>| {
            Spectrum::new(name, emission_nm.to_vec(), values)
                .map(|spectrum| Spectrum { interpolation: Interpolation::Linear, ..spectrum })
        };
        Ok(Self {
            reflectance: spectrum(reflectance)?.as_reflectance(),
            fluorescence: fluorescence
                .column_iter()
                .map(|column| spectrum(column.iter().copied().collect()))
                .collect::<Result<_>>()?,
            excitation,
        })
    }

    /// Reads a matrix from CSV, with wavelengths of emission in the first column and those of excitation in
    /// the header, or from the export of a Labsphere BFC-450.
    ///
    /// # Errors
    /// As [`Donaldson::new`]; [`Error::File`] or [`Error::Table`] for a file that cannot be read,
    /// [`Error::Spectrum`] for a column whose name is not a wavelength.
    pub fn read(path: &str) -> Result<Self> {
        let columns = formats::read(path, formats::no_json)?.spectra(path);
        let wavelength_nm = |column: &Spectrum| {
            column.name().parse::<f64>().map_err(|_| {
                let problem =
                    format!("the name of column '{}' is not an excitation wavelength", column.name());
                Error::spectrum(path, problem, "write it as a number, in nm")
            })
        };
        let excitation_nm = columns.iter().map(wavelength_nm).collect::<Result<Vec<_>>>()?;
        let [first, others @ ..] = columns.as_slice() else {
            return Err(Error::spectrum(path, "it has no columns", "write one per excitation wavelength"));
        };
        if others.iter().any(|column| column.wavelengths_nm() != first.wavelengths_nm()) {
            let problem = "its columns have different wavelengths";
            return Err(Error::spectrum(
                path,
                problem,
                "write the same wavelengths of emission for all of them",
            ));
        }
        let emission = WavelengthGrid::new(first.wavelengths_nm().to_vec())?;
        let factors = DMatrix::from_fn(emission.len(), columns.len(), |row, n| columns[n].values()[row]);
        let stem = std::path::Path::new(path).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Self::new(&stem, emission, WavelengthGrid::new(excitation_nm)?, &factors)
    }

    /// The sheet's reflectance, with the sheet's name.
    #[must_use]
    pub fn reflectance(&self) -> &Spectrum {
        &self.reflectance
    }

    /// The shortest wavelength that excites the sheet, nm, if any does.
    #[must_use]
    pub fn excited_from_nm(&self) -> Option<f64> {
        let excites = |column: &Spectrum| column.values().iter().any(|factor| *factor > NO_NOISE);
        self.fluorescence.iter().position(excites).map(|band| self.excitation.wavelengths_nm()[band])
    }

    /// The matrix on a scene's wavelengths. Outside the wavelengths of emission the sheet is assumed to
    /// reflect as at the nearest of them: instruments measure emission from 380 nm, but light from 300 nm
    /// excites the sheet, and bounces, too.
    ///
    /// # Errors
    /// [`Error::Spectrum`] if the emission does not cover the scene's wavelengths.
    pub fn on(&self, grid: &WavelengthGrid) -> Result<Bispectral> {
        let columns = |grid: &WavelengthGrid| {
            let columns = self.fluorescence.iter().map(|column| column.on(grid, Outside::Zero));
            Ok::<_, Error>(DMatrix::from_vec(
                grid.len(),
                self.fluorescence.len(),
                columns.collect::<Result<Vec<_>>>()?.concat(),
            ))
        };
        let mut between_bands = columns(&self.excitation)?;
        let reflected = self.reflectance.on(&self.excitation, Outside::Zero)?;
        let ((first_nm, last_nm), values) = (self.reflectance.range_nm(), self.reflectance.values());
        for (band, (nm, reflected)) in self.excitation.wavelengths_nm().iter().zip(reflected).enumerate() {
            between_bands[(band, band)] += match *nm {
                nm if nm < first_nm => values[0],
                nm if nm > last_nm => values[values.len() - 1],
                _ => reflected,
            };
        }
        Ok(Bispectral {
            reflectance: self.reflectance.on(grid, Outside::Refuse)?,
            fluorescence: columns(grid)?,
            excitation: self.excitation.clone(),
            between_bands,
        })
    }
}
