//! A camera's RAW file: DNG, CR2, CR3, NEF, ARW, RAF and others that the crate rawler decodes.

mod dng;
mod layout;
mod levels;
mod opcodes;
mod refused;
mod sensor;
mod taken;
mod tiff_directories;

use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Once};

use rawler::decoders::RawDecodeParams;
use rawler::exif::Exif;
use rawler::formats::tiff::Rational;
use rawler::imgop::xyz::Illuminant;
use rawler::rawsource::RawSource;
use rawler::{RawImage, RawImageData, RawlerError};

use self::dng::Dng;
use self::refused::{check_size, damaged};
use self::sensor::Sensor;
use self::tiff_directories::Tiff;
use super::refused::one_line;
use crate::image::numbers::{ReadOptions, Transfer};
use crate::image::photograph::{CameraNotes, Orientation, Photograph};
use crate::{Error, Result};

/// Remedy if a decoder gives no reason that says which.
const UNREAD_OR_DAMAGED: &str = "this vfold does not read files of this kind, or the file is damaged: \
                                 copy it again, or convert it to linear TIFF";

/// Reads a RAW file.
///
/// # Errors
/// As [`Photograph::open`]; [`Error::Usage`] if a curve other than the linear one is requested.
pub(super) fn open(path: &Path, mut bytes: Vec<u8>, options: &ReadOptions) -> Result<Photograph> {
    if options.transfer == Transfer::Srgb {
        let problem = format!("{} is a RAW file, whose numbers are linear", path.display());
        return Err(Error::usage("--transfer", problem, "leave it out"));
    }
    if let Some(fault) = tiff_directories::fault(&bytes) {
        return Err(damaged(path, one_line(&fault)));
    }
    let dng = Tiff::new(&bytes).map_or(Ok(None), |tiff| Dng::read(path, tiff))?;
    if let Some(dng) = &dng {
        dng.shown.to(&mut bytes);
    }
    let Decoded { image, exif } = decode(path, bytes)?;
    let camera = camera_notes(&image, &exif);
    match dng {
        Some(dng) => Sensor::of_dng(path, image, dng, options)?.photograph(path, camera),
        None => Sensor::of_camera(path, image, options)?.photograph(path, camera),
    }
}

/// The decoder's result.
struct Decoded {
    image: RawImage,
    exif: Exif,
}

/// Decodes a file. Decoders panic on some files, which is reported like their other errors, but without the
/// words, which are a programmer's.
fn decode(path: &Path, bytes: Vec<u8>) -> Result<Decoded> {
    let source = RawSource::new_from_shared_vec(Arc::new(bytes)).with_path(path);
    let decode = || -> std::result::Result<Decoded, RawlerError> {
        let (decoder, parameters) = (rawler::get_decoder(&source)?, RawDecodeParams::default());
        let image = decoder.raw_image(&source, &parameters, false)?;
        let exif = decoder.raw_metadata(&source, &parameters)?.exif;
        Ok(Decoded { image, exif })
    };
    let decoded = without_panic_messages(|| panic::catch_unwind(AssertUnwindSafe(decode)))
        .map_err(|_| Error::picture(path, "its decoder failed", UNREAD_OR_DAMAGED))?
        .map_err(|error| undecodable(path, error))?;
    let RawImage { width, height, cpp, data, .. } = &decoded.image;
    let samples = match data {
        RawImageData::Integer(data) => data.len(),
        RawImageData::Float(data) => data.len(),
    };
    check_size(path, decoded.image.dim(), *cpp)?;
    if samples != width * height * cpp {
        return Err(damaged(path, format!("{samples} numbers do not fill {width} x {height} px")));
    }
    Ok(decoded)
}

fn undecodable(path: &Path, error: RawlerError) -> Error {
    match error {
        // no file of a known camera, wherever it names itself
        RawlerError::Unsupported { make, model, .. } if make.is_empty() && model.is_empty() => {
            let problem = "it names no camera whose RAW files this vfold reads; a TIFF that begins like this \
                           keeps its full picture in a sub-directory (SubIFD) of a small one";
            let remedy = "convert a RAW file to DNG or linear TIFF; of a TIFF, save the full picture alone";
            Error::picture(path, problem, remedy)
        }
        RawlerError::Unsupported { what, model, make, mode } => {
            let problem = one_line(&format!("this vfold does not read it: {what}: {make} {model} {mode}"));
            Error::picture(path, problem, "convert the file to DNG or linear TIFF")
        }
        RawlerError::DecoderFailed(message) => {
            let problem = format!("its decoder failed: {}", one_line(&message));
            Error::picture(path, problem, UNREAD_OR_DAMAGED)
        }
    }
}

/// Suppresses the messages of panics, which are printed even if they are caught, while any thread decodes a
/// file.
fn without_panic_messages<T>(work: impl FnOnce() -> T) -> T {
    static QUIET: AtomicUsize = AtomicUsize::new(0);
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if QUIET.load(Ordering::Relaxed) == 0 {
                print(panic);
            }
        }));
    });
    QUIET.fetch_add(1, Ordering::Relaxed);
    let done = work();
    QUIET.fetch_sub(1, Ordering::Relaxed);
    done
}

/// The rows of a 3 x 3 matrix; none for other sizes.
fn xyz_to_camera(matrix: &[f32]) -> Option<[[f64; 3]; 3]> {
    let nine: [f32; 9] = matrix.try_into().ok()?;
    Some(std::array::from_fn(|row| std::array::from_fn(|column| f64::from(nine[3 * row + column]))))
}

fn camera_notes(image: &RawImage, exif: &Exif) -> CameraNotes {
    let ratio = |ratio: &Option<Rational>| {
        let value = ratio.as_ref().map(|ratio| f64::from(ratio.n) / f64::from(ratio.d));
        value.filter(|value| value.is_finite() && *value > 0.0)
    };
    let text = |text: &str| Some(text.trim().to_owned()).filter(|text| !text.is_empty());
    CameraNotes {
        make: text(&image.make),
        model: text(&image.model),
        exposure_s: ratio(&exif.exposure_time),
        f_number: ratio(&exif.fnumber),
        focal_mm: ratio(&exif.focal_length),
        iso: exif.iso_speed_ratings.map(u32::from).or(exif.iso_speed),
        orientation: Orientation::from_exif(exif.orientation.unwrap_or(1).into()).unwrap_or_default(),
        xyz_to_camera: image.color_matrix.get(&Illuminant::D65).and_then(|matrix| xyz_to_camera(matrix)),
        taken: taken::taken(exif),
        ..CameraNotes::default()
    }
}
