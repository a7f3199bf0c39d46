//! A camera's RAW file: DNG, CR2, CR3, NEF, ARW, RAF and what else the crate rawler decodes.

mod opcodes;
mod sensor;
mod taken;
mod tiff_directories;

use std::any::Any;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Once};

use rawler::decoders::{FormatHint, RawDecodeParams};
use rawler::exif::Exif;
use rawler::formats::tiff::Rational;
use rawler::imgop::xyz::Illuminant;
use rawler::rawsource::RawSource;
use rawler::{RawImage, RawImageData, RawlerError};

use self::sensor::Sensor;
use super::decode::{DAMAGED, MAX_BYTES, TOO_LARGE, one_line};
use crate::image::numbers::{ReadOptions, Transfer};
use crate::image::photograph::{CameraNotes, Orientation, Photograph};
use crate::room;
use crate::{Error, Result};

/// Reads a RAW file.
///
/// # Errors
/// As [`Photograph::open`]; [`Error::Usage`] if another curve than the linear one is asked for.
pub(super) fn open(path: &Path, bytes: Vec<u8>, options: &ReadOptions) -> Result<Photograph> {
    if options.transfer == Transfer::Srgb {
        let problem = format!("{} is a RAW file, whose numbers are linear", path.display());
        return Err(Error::usage("--transfer", problem, "leave it out"));
    }
    let Decoded { image, exif, is_dng, undone } = decode(path, bytes)?;
    if let Some(opcode) = undone {
        let problem =
            format!("its numbers are light only after {opcode}, one of DNG's opcodes, which are not applied");
        return Err(Error::picture(
            path,
            problem,
            "convert it to linear TIFF with a program that does, or take the camera's own RAW file",
        ));
    }
    let camera = camera_notes(&image, &exif);
    Sensor::new(path, image, is_dng, options)?.photograph(path, camera)
}

/// What a decoder made of a file.
struct Decoded {
    image: RawImage,
    exif: Exif,
    is_dng: bool,
    /// What is still to be done to its numbers.
    undone: Option<&'static str>,
}

/// Decodes a file. The decoders stop at some damaged files with a panic, which is reported like their other errors.
fn decode(path: &Path, bytes: Vec<u8>) -> Result<Decoded> {
    let failed = |message: &str| Error::picture(path, one_line(message), DAMAGED);
    if let Some(fault) = tiff_directories::fault(&bytes) {
        return Err(failed(&fault));
    }
    let source = RawSource::new_from_shared_vec(Arc::new(bytes)).with_path(path);
    let decode = || -> std::result::Result<Decoded, RawlerError> {
        let (decoder, parameters) = (rawler::get_decoder(&source)?, RawDecodeParams::default());
        let image = decoder.raw_image(&source, &parameters, false)?;
        let exif = decoder.raw_metadata(&source, &parameters)?.exif;
        let undone = opcodes::needed(decoder.as_ref());
        Ok(Decoded { image, exif, is_dng: decoder.format_hint() == FormatHint::DNG, undone })
    };
    let decoded = without_panic_messages(|| panic::catch_unwind(AssertUnwindSafe(decode)))
        .map_err(|payload| failed(panic_message(payload.as_ref())))?
        .map_err(|error| match error {
            RawlerError::Unsupported { what, model, make, mode } => {
                let problem = one_line(&format!("{what}: {make} {model} {mode}"));
                Error::picture(path, problem, "convert the file to DNG or linear TIFF")
            }
            RawlerError::DecoderFailed(message) => failed(&message),
        })?;
    check_size(path, &decoded.image)?;
    Ok(decoded)
}

fn check_size(path: &Path, image: &RawImage) -> Result<()> {
    let RawImage { width, height, cpp, .. } = image;
    let samples = match &image.data {
        RawImageData::Integer(data) => data.len(),
        RawImageData::Float(data) => data.len(),
    };
    if samples as u64 * size_of::<f32>() as u64 > MAX_BYTES {
        let problem = format!("{width} x {height} px would take more than 2 GiB");
        return Err(Error::picture(path, problem, TOO_LARGE));
    }
    room::ask(samples as u64 * size_of::<f32>() as u64, &path.display().to_string(), TOO_LARGE)?;
    if samples == 0 || samples != width.saturating_mul(*height).saturating_mul(*cpp) {
        let problem = format!("{samples} numbers do not fill {width} x {height} px");
        return Err(Error::picture(path, problem, DAMAGED));
    }
    Ok(())
}

/// Panics are printed when they happen, also those that are caught: not while a file is decoded, on any thread.
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

fn panic_message(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("the decoder gave up")
}

/// Rows of three of a matrix that has three.
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
        iso: exif.iso_speed_ratings.map(u32::from).or(exif.iso_speed),
        orientation: Orientation::from_exif(exif.orientation.unwrap_or(1).into()).unwrap_or_default(),
        xyz_to_camera: image.color_matrix.get(&Illuminant::D65).and_then(|matrix| xyz_to_camera(matrix)),
        taken: taken::taken(exif),
        ..CameraNotes::default()
    }
}
