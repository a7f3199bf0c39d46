//! The cloudless sky against pvlib 0.16.1, as `tests/data/clear-sky/make.py` took it: `spectrl2` and the
//! places of the sun by `spa_python`.

use serde_json::Value;
use vfold::spectrum::{ClearSky, Outside, Spectrum, Sun, WavelengthGrid, illuminant};

fn cases(text: &str) -> Vec<Value> {
    serde_json::from_str(text).unwrap()
}

#[test]
fn spectra_are_those_of_pvlib() {
    let mut worst = 0.0_f64;
    let skies = cases(include_str!("../data/clear-sky/spectrl2.json"));
    assert_eq!(skies.len(), 20);
    for sky in &skies {
        let number = |name: &str| sky[name].as_f64().unwrap();
        let day = sky["day_of_year"].as_u64().unwrap().try_into().unwrap();
        let computed = ClearSky {
            sun: Sun::at_zenith_deg(number("zenith_deg")).unwrap().on_day(day),
            pressure_pa: number("pressure_pa"),
            turbidity: number("turbidity"),
            water_cm: number("water_cm"),
            ozone_atm_cm: number("ozone_atm_cm"),
            ground_albedo: number("ground_albedo"),
        };
        for (name, spectrum) in [("dni", computed.direct()), ("dhi", computed.diffuse())] {
            let (ours, theirs) = (spectrum.unwrap(), sky[name].as_array().unwrap());
            assert_eq!(ours.values().len(), theirs.len());
            for (ours, theirs) in ours.values().iter().zip(theirs) {
                let theirs = theirs.as_f64().unwrap();
                worst = worst.max((ours - theirs).abs() / theirs.max(1e-6));
            }
        }
    }
    println!("clear skies: {} of pvlib, worst difference {worst:.1e} of the value", skies.len());
    assert!(worst < 1e-5, "{worst}");
}

#[test]
fn the_sun_stands_where_pvlib_has_it() {
    let mut worst = 0.0_f64;
    for place in cases(include_str!("../data/clear-sky/sun.json")) {
        let (latitude, longitude) = (&place["latitude_deg"], &place["longitude_deg"]);
        let sun = Sun::parse(&format!("{latitude},{longitude},{}", place["time"].as_str().unwrap())).unwrap();
        worst = worst.max((sun.zenith_deg() - place["zenith_deg"].as_f64().unwrap()).abs());
    }
    println!("place of the sun: within {worst:.4}° of pvlib");
    // pvlib takes 12 °C for its refraction, the crate 10 °C
    assert!(worst < 5e-3, "{worst}°");
}

/// Low sun is redder, and the sky bluer than the sun, as daylight of 6500 K is not.
#[test]
fn colours_are_those_of_a_clear_day() {
    let grid = WavelengthGrid::uniform(450.0, 650.0, 200.0).unwrap();
    let blue_over_red = |spectrum: &Spectrum| {
        let power = spectrum.on(&grid, Outside::Refuse).unwrap();
        power[0] / power[1]
    };
    let of = |spec: &str| blue_over_red(&illuminant(spec).unwrap());
    assert!(of("sun:80deg") < of("sun:40deg") && of("sun:40deg") < of("sun:0deg"));
    assert!(of("sun:0deg") < of("D65") && of("D65") < of("sky:40deg"));
}
