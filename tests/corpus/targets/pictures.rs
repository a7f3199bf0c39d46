//! Photographs.

use vfold::camera::{Predictor, StandIns};
use vfold::image::{
    Grid, Homography, Photograph, Pixel, Point, ReadOptions, Transfer, measure, pixels_sharing_noise,
    write_linear,
};

use vfold::spectrum::{Sun, WavelengthGrid, camera, camera_by_exif};

use super::{assert_finite, taken, with_file};

/// Largest picture that is looked at pixel by pixel.
const MAX_PIXELS: usize = 1 << 14;

pub fn picture(bytes: &[u8]) {
    with_file("a", bytes, |path| {
        let srgb = ReadOptions { transfer: Transfer::Srgb, ..ReadOptions::default() };
        let by_its_word = taken(Photograph::open(path, &ReadOptions::default()));
        let by_ours = taken(Photograph::open(path, &srgb));
        assert!(
            by_its_word.is_none() || by_ours.is_some(),
            "only what a file says of its numbers can be overruled"
        );
        for photograph in by_its_word.iter().chain(&by_ours) {
            let (width, height) = (photograph.width(), photograph.height());
            assert!(width > 0 && height > 0);
            look_at_what_it_says(photograph);
            if width * height <= MAX_PIXELS {
                look_at(photograph);
            }
        }
    });
}

/// A RAW file, whose numbers are linear.
#[cfg(feature = "raw")]
pub fn raw(bytes: &[u8]) {
    with_file("a.dng", bytes, |path| {
        let photograph = taken(Photograph::open(path, &ReadOptions::default()));
        photograph.iter().for_each(look_at_what_it_says);
        let small = photograph.filter(|photograph| photograph.width() * photograph.height() <= MAX_PIXELS);
        small.iter().for_each(look_at);
    });
}

fn look_at(photograph: &Photograph) {
    let (width, height) = (photograph.width(), photograph.height());
    let mut lights = Vec::new();
    for k in 0..width * height {
        match photograph.pixel(k % width, k / width) {
            Pixel::Light(light) => lights.extend(light),
            Pixel::Clipped | Pixel::NotFinite => lights.extend([0.0; 3]),
        }
    }
    assert_finite("pixels", &lights);
    assert_measured(photograph);
    assert_read_again(width, height, &lights);
}

/// The camera and the light that a photograph names are known, or another's stand in.
fn look_at_what_it_says(photograph: &Photograph) {
    let info = photograph.info();
    let of = |text: &Option<String>| text.clone().unwrap_or_default();
    let (make, model) = (of(&info.camera.make), of(&info.camera.model));
    let named = camera_by_exif(&make, &model);
    if let Some(matrix) = &info.camera.xyz_to_camera
        && let Some(curves) = Predictor::new(&WavelengthGrid::default()).unwrap().predict(&make, matrix)
    {
        assert_finite("predicted curves", curves.iter().flatten());
    }
    let name = named.unwrap_or_else(|| StandIns::new().unwrap().for_camera(&make).name);
    assert_eq!(camera(&name).unwrap().channels.len(), 3, "{make} {model}");
    let place = info.camera.taken.place_deg;
    assert_finite("place", place.iter().flatten());
    if let (Some([latitude, longitude]), Some(time)) = (place, &info.camera.taken.time) {
        taken(Sun::parse(&format!("{latitude:.2},{longitude:.2},{time}")));
    }
}

/// Measures a sheet that fills the picture.
fn assert_measured(photograph: &Photograph) {
    let (w, h) = (photograph.width() as f64, photograph.height() as f64);
    let corners = [(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)].map(|(x, y)| Point::new(x, y));
    let outline = Homography::from_unit_square(corners).unwrap();
    assert_finite("noise", &pixels_sharing_noise(photograph, std::slice::from_ref(&outline)));
    let facets = taken(measure(photograph, &[Grid::even(outline, [2, 2])], 0.0));
    for facet in facets.iter().flatten() {
        assert_finite("facets", facet.mean.iter().chain(&facet.standard_error).flatten());
    }
}

/// Light written as OpenEXR is read again, in single precision, which it must fit.
fn assert_read_again(width: usize, height: usize, lights: &[f64]) {
    let fits = lights.iter().all(|light| (*light as f32).is_finite());
    with_file("b.exr", &[], |path| {
        assert_eq!(write_linear(path, width, height, lights).is_ok(), fits);
        if !fits {
            return;
        }
        let again = Photograph::open(path, &ReadOptions::default()).unwrap();
        for (k, light) in lights.chunks(3).enumerate() {
            let wanted = std::array::from_fn(|channel| f64::from(light[channel] as f32));
            assert_eq!(again.pixel(k % width, k / width), Pixel::Light(wanted));
        }
    });
}
