//! Tables of spectra.

use crate::{assert_refused, case};

#[test]
fn tables_of_spectra() {
    assert_refused(
        r"
        vkernel --facets 1x1 -o scene.json
        printf 'nm,r\n400,0.1\n500,NaN\n700,0.3\n' > nan.csv
        printf 'nm,r\n400,0.1\n400,0.2\n700,0.3\n' > twice.csv
        printf 'nm,r\n400,0.1\n500\n700,0.3\n' > ragged.csv
        printf '400,0.1\n700,0.3\n' > headless.csv
        printf 'nm,r\n450,0.1\n700,0.3\n' > narrow.csv
        printf 'nm,r\n400,10\n700,900\n' > large.csv
        printf 'nm,r [%%]\n400,0.1\n700,0.9\n' > ambiguous.csv
        printf 'wavelength (um),r\n0.4,0.1\n700,0.3\n' > mixed.csv
        printf 'nm,r\n400,-0.1\n700,0.3\n' > negative.csv
        printf 'nm;r\n400;0,1\n700;0.3\n' > marks.csv
        printf 'nm|r\n400|0.1\n700|0.3\n' > bars.csv
        printf 'nm,r\n400,\0420.1\n700,0.3\n' > quote.csv
        printf 'nm,r\n0.4,0.1\n0.7,0.3\n' > micrometres.csv
        printf 'nm,r\n' > rowless.csv
        : > empty.csv
        head -c 300 /bin/sh > binary.csv
        printf 'nm,r\n400,0\n700,0\n' > dark.csv",
        &[
            case("vforward scene.json --reflectance twice.csv", 1, &["twice.csv:3", "400"]),
            case("vforward scene.json --reflectance ragged.csv", 1, &["ragged.csv:3", "columns"]),
            case("vforward scene.json --reflectance headless.csv", 1, &["headless.csv:1", "header"]),
            case(
                "vforward scene.json --reflectance narrow.csv",
                1,
                &["narrow", "450..700 nm", "400..700 nm"],
            ),
            case("vforward scene.json --reflectance large.csv", 1, &["large", "10 is outside", "percent"]),
            case(
                "vforward scene.json --reflectance ambiguous.csv",
                1,
                &["ambiguous.csv:1", "r [%]", "fractions"],
            ),
            case("vforward scene.json --reflectance mixed.csv", 1, &["mixed.csv:3", "micrometres"]),
            case("vforward scene.json --reflectance negative.csv", 1, &["negative", "-0.1"]),
            case("vforward scene.json --reflectance marks.csv", 1, &["marks.csv:3", "decimal mark", "','"]),
            case("vforward scene.json --reflectance bars.csv", 1, &["bars.csv:1", "','", "tabs"]),
            case("vforward scene.json --reflectance quote.csv", 1, &["quote.csv:2", "quote"]),
            case("vforward scene.json --reflectance micrometres.csv", 1, &["micrometres.csv:2", "um"]),
            case("vforward scene.json --reflectance rowless.csv", 1, &["rowless.csv", "two wavelengths"]),
            case("vforward scene.json --reflectance empty.csv", 1, &["empty.csv:1", "header"]),
            case("vforward scene.json --reflectance binary.csv", 1, &["binary.csv"]),
            case("vforward scene.json --reflectance nan.csv:g", 1, &["nan.csv"]),
            case("vforward scene.json --reflectance ragged.csv cc24", 1, &["ragged.csv:3"]),
            case("vforward scene.json --reflectance 0.5 --illuminant dark.csv", 1, &["dark", "zero"]),
            case("vforward scene.json --reflectance 0.5 --camera dark.csv", 1, &["zero"]),
            case("vestimate scene.json --prior ragged.csv", 1, &["ragged.csv:3"]),
        ],
    );
}
