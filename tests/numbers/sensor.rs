//! Simulated sensors: mosaics measured where their sites are, and noise that demosaicing, scaling and JPEG
//! spread.

use std::path::Path;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use serde_json::Value;
use vfold::image::{
    FacetMeasurement, Grid, Homography, Mosaic, Photograph, Pixel, Point, ReadOptions, measure,
    pixels_sharing_noise,
};

const PHOTO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

// ---- mosaics ----

const X_TRANS: &str = "GGRGGBGGBGGRBRGRBGGGBGGRGGRGGBRBGBRG";

/// The rendered photograph as a sensor under a mosaic sees it, and its sidecar.
fn mosaic_of_photo(letters: &str) -> (Photograph, Value) {
    let photograph = Photograph::open(Path::new(PHOTO), &ReadOptions::default()).unwrap();
    let mosaic = Mosaic::new(letters).unwrap();
    let (width, height) = (photograph.width(), photograph.height());
    let site = |k: usize| match photograph.pixel(k % width, k / width) {
        Pixel::Light(light) => light[mosaic.colour(k % width, k / width)] as f32,
        _ => f32::NAN,
    };
    let light = (0..width * height).map(site).collect();
    let sidecar = std::fs::read_to_string(Path::new(PHOTO).with_extension("json")).unwrap();
    (Photograph::from_mosaic(mosaic, width, height, light).unwrap(), serde_json::from_str(&sidecar).unwrap())
}

fn panels(sidecar: &Value) -> [Homography; 2] {
    ["A", "B"].map(|panel| {
        let corner = |end: &str| {
            let at = &sidecar["panels_px"][panel][end];
            Point::new(at[0].as_f64().unwrap(), at[1].as_f64().unwrap())
        };
        Homography::from_unit_square(["crease_0", "crease_1", "outer_1", "outer_0"].map(corner)).unwrap()
    })
}

/// Relative errors of a channel's 200 facets, percent.
fn errors_percent(facets: &[FacetMeasurement], sidecar: &Value, channel: usize) -> Vec<f64> {
    let truth = &sidecar["facet_mean_rgb_10x10"];
    let error = |(k, facet): (usize, &FacetMeasurement)| {
        let want = truth[["A", "B"][k / 100]][k / 10 % 10][k % 10][channel].as_f64().unwrap();
        100.0 * (facet.mean.as_ref().unwrap()[channel] / want - 1.0)
    };
    facets.iter().enumerate().map(error).collect()
}

/// Two by two sites taken as one point are off by 0.25, 0.07 and 0.14 % rms, and by 0.17 % in a panel's mean.
#[test]
fn a_mosaic_gives_the_radiosity_solution() {
    for letters in ["RGGB", "GRBG", "BGGR", X_TRANS] {
        let (photograph, sidecar) = mosaic_of_photo(letters);
        let facets = measure(&photograph, &grids(&panels(&sidecar), [10, 10]), 0.0).unwrap();
        for channel in 0..3 {
            let errors = errors_percent(&facets, &sidecar, channel);
            let means = [0, 100].map(|from| errors[from..from + 100].iter().sum::<f64>() / 100.0);
            println!("{letters} channel {channel}: rms {:.3} %, panels {means:.3?} %", rms(&errors));
            assert!(rms(&errors) < 0.1 && means.iter().all(|mean| mean.abs() < 0.02), "{letters} {channel}");
        }
    }
}

#[test]
fn a_clipped_site_spoils_its_own_colour_alone() {
    let panel = Homography::from_unit_square(
        [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)].map(|(x, y)| Point::new(x, y)),
    )
    .unwrap();
    let mosaic = Mosaic::new("RGGB").unwrap();
    let light = (0..64).map(|k| match mosaic.colour(k % 8, k / 8) {
        0 => f32::INFINITY,
        colour => colour as f32,
    });
    let photograph = Photograph::from_mosaic(mosaic.clone(), 8, 8, light.collect()).unwrap();
    let facet = measure(&photograph, &grids(std::slice::from_ref(&panel), [1, 1]), 0.0).unwrap().remove(0);
    assert_eq!((facet.mean, facet.pixels, facet.clipped), (None, 48.0, 16));
    let light =
        (0..64).map(|k| if k == 0 { f32::INFINITY } else { 1.0 + mosaic.colour(k % 8, k / 8) as f32 });
    let photograph = Photograph::from_mosaic(mosaic.clone(), 8, 8, light.collect()).unwrap();
    let facet = measure(&photograph, &grids(&[panel], [1, 1]), 0.0).unwrap().remove(0);
    assert_eq!((facet.mean.unwrap(), facet.clipped), (vec![1.0, 2.0, 3.0], 1));
}

#[test]
fn what_is_no_picture_is_refused() {
    let bayer = || Mosaic::new("RGGB").unwrap();
    for (width, height, count) in [(2, 9, 18), (9, 2, 18), (3, 3, 10), (usize::MAX, 3, 9), (0, 0, 0)] {
        assert!(
            Photograph::from_mosaic(bayer(), width, height, vec![0.0; count]).is_err(),
            "{width} {height}"
        );
        assert!(Photograph::from_light(width, height, vec![0.0; count + 1]).is_err(), "{width} {height}");
    }
}

// ---- noise ----

const SIDE: usize = 420;
/// Noise of a pixel, of the light.
const NOISE: f64 = 0.04;

/// Light that falls off unevenly, as in a fold.
fn light(x: f64, y: f64) -> f64 {
    let (u, v) = (x / SIDE as f64, y / SIDE as f64);
    0.3 + 0.25 * (-2.0 * u).exp() + 0.05 * (1.0 - v * v) * u
}

/// Noisy light of square pixels `size` px wide, that is the one in column `x` and row `y`.
fn noisy(random: &mut ChaCha8Rng, x: usize, y: usize, size: f64) -> f64 {
    let noise: f64 = StandardNormal.sample(random);
    light(size * (x as f64 + 0.5), size * (y as f64 + 0.5)) * (1.0 + NOISE * noise)
}

/// RGB of every pixel, from a function of column, row and channel.
fn picture(mut rgb: impl FnMut(usize, usize, usize) -> f64) -> Photograph {
    let numbers = (0..SIDE * SIDE * 3).map(|k| rgb(k / 3 % SIDE, k / 3 / SIDE, k % 3) as f32);
    Photograph::from_light(SIDE, SIDE, numbers.collect()).unwrap()
}

fn independent(random: &mut ChaCha8Rng) -> Photograph {
    picture(|x, y, _| noisy(random, x, y, 1.0))
}

/// A Bayer sensor's picture, each missing colour the mean of the nearest sites that have it.
fn demosaiced(random: &mut ChaCha8Rng) -> Photograph {
    let mosaic = Mosaic::new("RGGB").unwrap();
    let sites: Vec<f64> = (0..SIDE * SIDE).map(|k| noisy(random, k % SIDE, k / SIDE, 1.0)).collect();
    picture(|x, y, colour| {
        let at = |dx: usize, dy: usize| {
            let (x, y) = ((x + dx).clamp(1, SIDE) - 1, (y + dy).clamp(1, SIDE) - 1);
            (mosaic.colour(x, y) == colour).then(|| sites[y * SIDE + x])
        };
        let mean = |places: &[(usize, usize)]| {
            let found: Vec<f64> = places.iter().filter_map(|&(dx, dy)| at(dx, dy)).collect();
            (!found.is_empty()).then(|| found.iter().sum::<f64>() / found.len() as f64)
        };
        let cross = mean(&[(0, 1), (2, 1), (1, 0), (1, 2)]);
        at(1, 1).or(cross).or(mean(&[(0, 0), (2, 0), (0, 2), (2, 2)])).unwrap()
    })
}

/// A picture of half the size, scaled up by linear interpolation.
fn scaled(random: &mut ChaCha8Rng) -> Photograph {
    let half = SIDE / 2;
    let small: Vec<f64> = (0..half * half).map(|k| noisy(random, k % half, k / half, 2.0)).collect();
    let weights = |at: usize| {
        let near = at / 2;
        let far = if at.is_multiple_of(2) { near.saturating_sub(1) } else { (near + 1).min(half - 1) };
        [(near, 0.75), (far, 0.25)]
    };
    picture(|x, y, _| {
        let row = |y: usize| weights(x).iter().map(|&(x, w)| w * small[y * half + x]).sum::<f64>();
        weights(y).iter().map(|&(y, w)| w * row(y)).sum()
    })
}

/// A demosaiced picture as a JPEG of quality 95, in sRGB. Its rounding moves a grey picture's colours by up
/// to 0.1 %: the noise must be larger than that.
fn jpeg(random: &mut ChaCha8Rng) -> Photograph {
    let photograph = demosaiced(random);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("photo.jpg");
    let encoded = |light: f64| (255.0 * (1.055 * light.powf(1.0 / 2.4) - 0.055)).round() as u8;
    let rgb = image::RgbImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
        match photograph.pixel(x as usize, y as usize) {
            Pixel::Light(light) => image::Rgb(light.map(encoded)),
            _ => image::Rgb([0; 3]),
        }
    });
    let file = std::fs::File::create(&path).unwrap();
    image::codecs::jpeg::JpegEncoder::new_with_quality(file, 95).encode_image(&rgb).unwrap();
    Photograph::open(&path, &ReadOptions::default()).unwrap()
}

fn mosaic(random: &mut ChaCha8Rng) -> Photograph {
    let sites = (0..SIDE * SIDE).map(|k| noisy(random, k % SIDE, k / SIDE, 1.0) as f32).collect();
    Photograph::from_mosaic(Mosaic::new("RGGB").unwrap(), SIDE, SIDE, sites).unwrap()
}

/// A panel in the picture's middle, a little turned.
fn panel() -> Homography {
    let corners = [(25.3, 12.8), (20.1, 400.6), (402.7, 404.2), (396.4, 18.9)];
    Homography::from_unit_square(corners.map(|(x, y)| Point::new(x, y))).unwrap()
}

/// What makes a photograph of the light, with its noise.
type Camera = fn(&mut ChaCha8Rng) -> Photograph;

/// Facet means of the light itself, from a photograph without noise.
fn noise_free() -> Vec<f64> {
    let photograph = picture(|x, y, _| light(x as f64 + 0.5, y as f64 + 0.5));
    let facets = measure(&photograph, &grids(&[panel()], [10, 10]), 0.0).unwrap();
    facets.into_iter().map(|facet| facet.mean.unwrap()[0]).collect()
}

/// Errors of all facets and channels, in standard errors as they are with and without regard to shared noise.
fn errors_in_standard_errors(take: Camera) -> [f64; 2] {
    let truth = noise_free();
    let mut errors = [Vec::new(), Vec::new()];
    for seed in 0..4 {
        let photograph = take(&mut ChaCha8Rng::seed_from_u64(seed));
        let sharing = pixels_sharing_noise(&photograph, &[panel()]);
        for (facet, truth) in
            measure(&photograph, &grids(&[panel()], [10, 10]), 0.0).unwrap().into_iter().zip(&truth)
        {
            for (facet, errors) in [facet.clone().with_shared_noise(&sharing), facet].iter().zip(&mut errors)
            {
                let (means, standard_errors) =
                    (facet.mean.as_ref().unwrap(), facet.standard_error.as_ref().unwrap());
                errors.extend(means.iter().zip(standard_errors).map(|(mean, error)| (mean - truth) / error));
            }
        }
    }
    errors.map(|errors| rms(&errors))
}

#[test]
fn standard_errors_know_of_shared_noise() {
    let kinds: [(&str, Camera); 5] = [
        ("independent", independent),
        ("mosaic", mosaic),
        ("demosaiced", demosaiced),
        ("scaled", scaled),
        ("JPEG", jpeg),
    ];
    for (name, take) in kinds {
        let [knowing, ignorant] = errors_in_standard_errors(take);
        println!(
            "{name}: errors are {knowing:.2} standard errors, {ignorant:.2} if every pixel's noise is its own"
        );
        assert!((knowing - 1.0).abs() < 0.15, "{name}: {knowing}");
    }
}

#[test]
fn small_panels_say_nothing_of_shared_noise() {
    let photograph = demosaiced(&mut ChaCha8Rng::seed_from_u64(0));
    let tiny = [(5.0, 5.0), (20.0, 5.0), (20.0, 20.0), (5.0, 20.0)].map(|(x, y)| Point::new(x, y));
    let tiny = Homography::from_unit_square(tiny).unwrap();
    assert_eq!(pixels_sharing_noise(&photograph, &[tiny]), [1.0; 3]);
    let clipped = Photograph::from_light(SIDE, SIDE, vec![f32::INFINITY; SIDE * SIDE]).unwrap();
    assert_eq!(pixels_sharing_noise(&clipped, &[panel()]), [1.0]);
    let dark = Photograph::from_light(SIDE, SIDE, vec![0.0; SIDE * SIDE]).unwrap();
    assert_eq!(pixels_sharing_noise(&dark, &[panel()]), [1.0]);
}

/// Panels with rows and columns of one size.
fn grids(panels: &[Homography], rows_and_cols: [usize; 2]) -> Vec<Grid> {
    let grid = |(k, panel): (usize, &Homography)| Grid {
        panel: Some(k),
        ..Grid::even(panel.clone(), rows_and_cols)
    };
    panels.iter().enumerate().map(grid).collect()
}
