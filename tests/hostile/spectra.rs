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
        printf 'nm,r\n400,0.1\n700,1.44\n' > ambiguous.csv
        printf 'nm,grey 50%%\n400,0.1\n700,0.9\n' > sign.csv
        printf 'wavelength (um),r\n0.4,0.1\n700,0.3\n' > mixed.csv
        printf 'nm,r\n400,-0.1\n700,0.3\n' > negative.csv
        printf 'nm;r\n400;0,1\n700;0.3\n' > marks.csv
        printf 'nm|r\n400|0.1\n700|0.3\n' > bars.csv
        printf 'nm,r\n400,\0420.1\n700,0.3\n' > quote.csv
        printf 'nm,r\n0.4,0.1\n0.7,0.3\n' > micrometres.csv
        printf 'nm,r\n' > rowless.csv
        printf 'no,wavelength\n1,400\n2,500\n3,700\n' > lonely.csv
        spectrum() {
            echo '<SpectralDistribution>'
            for nm; do printf '<SpectralData wavelength=\042%s\042>0.1</SpectralData>\n' $nm; done
            echo '</SpectralDistribution>'
        }
        {
            printf '<IESTM2714 version=\0421.0\042>\n'
            spectrum 300 400 700; spectrum 300 700
            echo '</IESTM2714>'
        } > two.spdx
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
                &["ambiguous.csv", "1.44 is outside 0..1", "fluorescent", "--percent"],
            ),
            case(
                "vforward scene.json --reflectance ambiguous.csv --percent=no",
                1,
                &["1.44 is outside 0..1"],
            ),
            case("vforward scene.json --reflectance 0.5 --percent=perhaps", 2, &["--percent", "perhaps"]),
            case("vscore scene.json --truth ambiguous.csv", 1, &["--percent"]),
            case(
                "vforward scene.json --reflectance sign.csv",
                1,
                &["'grey 50%'", "--percent=no if the values are fractions"],
            ),
            case("vforward scene.json --reflectance mixed.csv", 1, &["mixed.csv:3", "micrometres"]),
            case("vforward scene.json --reflectance negative.csv", 1, &["negative", "-0.1"]),
            case("vforward scene.json --reflectance marks.csv", 1, &["marks.csv:3", "decimal mark", "','"]),
            case("vforward scene.json --reflectance bars.csv", 1, &["bars.csv:1", "','", "tabs"]),
            case("vforward scene.json --reflectance quote.csv", 1, &["quote.csv:2", "quote"]),
            case("vforward scene.json --reflectance micrometres.csv", 1, &["micrometres.csv:2", "um"]),
            case("vforward scene.json --reflectance rowless.csv", 1, &["rowless.csv", "two wavelengths"]),
            case("vforward scene.json --donaldson lonely.csv", 1, &["lonely.csv", "one column per spectrum"]),
            case(
                "vforward scene.json --reflectance 0.5 --illuminant lonely.csv",
                1,
                &["lonely.csv", "one column per spectrum"],
            ),
            case("vforward scene.json --donaldson two.spdx", 1, &["two", "different wavelengths"]),
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

/// What is no text, or no table over wavelengths: each is called what it is.
#[test]
fn files_that_are_something_else() {
    assert_refused(
        r"
        vkernel --facets 1x1 -o scene.json
        printf 'nm,r\n400,0.1\n700,0.3\n' > paint.csv
        gzip -k paint.csv
        gzip -c paint.csv > gzip.csv
        printf '{}' | gzip -c > gzip.json
        printf 'PK\003\004\024\000\006\000' > book.csv
        printf 'PK\003\004\024\000\006\000' > book.xlsx
        printf '\320\317\021\340\241\261\032\341' > old.csv
        printf '\377\376\000\000n\000\000\000' > utf32.csv
        printf 'n\000m\000,\000r\000\n\0004\000' > cut.csv
        printf 'frequency (THz),r\n430,0.1\n790,0.3\n' > frequency.csv
        printf 'eV,r\n1.7,0.1\n3.2,0.3\n' > energy.csv
        printf 'wavenumber (cm-1),r\n400,0.1\n2900,0.3\n' > wavenumber.csv
        printf 'index,r\n0,0.1\n1,0.3\n' > numbered.csv
        printf ',R,\n400,1,\n700,1,\n' > trailing.csv
        printf 'sep=;\nnm;r\n400;x\n700;1\n' > sep.csv
        printf 'wavelength,r\nnm,%%\n400,x\n700,1\n' > units.csv",
        &[
            case("vforward scene.json --reflectance gzip.csv", 1, &["gzip.csv:1", "gzip", "gzip -dc first"]),
            case(
                "vforward scene.json --reflectance paint.csv.gz",
                1,
                &["paint.csv.gz:1", "gzip", "gzip -dc first"],
            ),
            case("vforward scene.json --reflectance 0.5 --camera gzip.json", 1, &["gzip.json:1", "gzip"]),
            case("vforward scene.json --reflectance book.csv", 1, &["book.csv:1", "spreadsheet", "CSV"]),
            case("vforward scene.json --reflectance book.xlsx", 1, &["book.xlsx:1", "spreadsheet", "CSV"]),
            case("vforward scene.json --reflectance old.csv", 1, &["old.csv:1", "spreadsheet (XLS)"]),
            case("vforward scene.json --reflectance utf32.csv", 1, &["utf32.csv:1", "UTF-32"]),
            case("vforward scene.json --reflectance cut.csv", 1, &["cut.csv:2", "columns"]),
            case("vforward scene.json --reflectance frequency.csv", 1, &["frequency.csv:1", "wavelengths"]),
            case("vforward scene.json --reflectance energy.csv", 1, &["'eV' does not hold wavelengths"]),
            case("vforward scene.json --reflectance wavenumber.csv", 1, &["does not hold wavelengths"]),
            case("vforward scene.json --reflectance numbered.csv", 1, &["numbered.csv:2", "wavelength 0"]),
            case("vforward scene.json --reflectance trailing.csv", 1, &["trailing.csv:1", "column 3"]),
            case("vforward scene.json --reflectance sep.csv", 1, &["sep.csv:3", "'x' is not a number"]),
            case("vforward scene.json --reflectance units.csv", 1, &["units.csv:3", "'x' is not a number"]),
        ],
    );
}

/// A number is no name of a light, and no grid is finer than any spectrum.
#[test]
fn lights_by_number_and_grids_without_end() {
    assert_refused(
        r#"
        vkernel --facets 1x1 -o scene.json
        vforward scene.json --reflectance 0.5 | vestimate -o sample.ndjson
        seq -s, 400 0.1 700 > nm
        head -n 1 sample.ndjson \
            | sed "s/\"wavelengths_nm\":\[[^]]*\]/\"wavelengths_nm\":[$(cat nm)]/" > fine.ndjson
        tail -n 1 sample.ndjson >> fine.ndjson"#,
        &[
            case(
                "vforward scene.json --reflectance 0.5 --illuminant 2856",
                2,
                &["--illuminant", "'2856'", "2856K", "flat spectrum"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --illuminant 5500.0",
                2,
                &["5500.0K", "daylight:5500.0", "flat spectrum (E, or 1)"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --sky-illuminant 65",
                2,
                &["--sky-illuminant", "2856K", "flat spectrum"],
            ),
            case("vscore sample.ndjson --illuminant 6504", 2, &["--illuminant", "daylight:6504"]),
            case("vestimate scene.json --plan --illuminant 5003", 2, &["--illuminant", "daylight:5003"]),
            case("vextract photo.tif --illuminant 3200", 2, &["--illuminant", "3200K"]),
            case("vforward scene.json --reflectance 0.5 --illuminant 99K", 1, &["99K", "1000..25000 K"]),
            case(
                "vforward scene.json --reflectance cc24:red --wavelengths-nm 400:700:0.02",
                2,
                &["15001 wavelengths, more than 2001", "larger step"],
            ),
            case("vestimate fine.ndjson", 1, &["fine.ndjson:1", "3001 wavelengths, more than 2001"]),
        ],
    );
}
