//! CGATS and IES TM-27 files that are none, files that spectra are written to, and the directory of own
//! spectra.

use crate::{assert_refused, case};

#[test]
fn cgats_tables() {
    assert_refused(
        r#"
        vkernel --facets 1x1 -o scene.json
        table() { printf 'CGATS.17\n%s\nBEGIN_DATA_FORMAT\n%s\nEND_DATA_FORMAT\nBEGIN_DATA\n%s\nEND_DATA\n' \
            "$1" "$2" "$3"; }
        table 'SPECTRAL_BANDS "-5"' 'SPEC_400 SPEC_700' '1 2' > negative.sp
        table 'SPECTRAL_BANDS "99999999999999999999"' 'SPEC_400 SPEC_700' '1 2' > endless.sp
        table 'NUMBER_OF_SETS 4000000000' 'SPEC_400 SPEC_700' '1 2' > lying.ti3
        table 'SPECTRAL_NORM "1e-300"' 'SPEC_400 SPEC_700' '1 2' > tiny.sp
        table '' 'SPEC_400 SPEC_700' '1 nan' > nan.sp
        table '' 'SPEC_400 SPEC_700' '1e308 1' > huge.sp
        table '' 'SAMPLE_ID SPEC_400 SPEC_700' '"a b" 0.1' > short.txt
        table '' 'RGB_R RGB_G' '1 2' > device.ti3
        table '' 'SPEC_450 SPEC_700' '0.1 0.2' > narrow.sp
        table '' 'SAMPLE_ID SPEC_400 SPEC_700' 'a 0.1 0.2' > member.sp
        printf 'SPECT\nBEGIN_DATA_FORMAT\nSPEC_400 SPEC_700\nEND_DATA_FORMAT\nBEGIN_DATA\n1 2\n' > cut.sp
        table 'MEAS_TYPE "TRANSMISSIVE"' 'SPEC_400 SPEC_700' '0.1 0.2' > film.sp
        {
            cat device.ti3
            printf 'BEGIN_DATA_FORMAT\nSPEC_400 SPEC_700\nEND_DATA_FORMAT\nBEGIN_DATA\n1\nEND_DATA\n'
        } > second.ti3
        { cat member.sp; cat member.sp; } > twice.sp
        printf '"' > quote.sp
        head -c 300 /bin/sh > binary.sp
        : > empty.ti3
        truncate -s 70M long.sp
        cat > forward <<'END'
        vforward scene.json --reflectance "$1"
END
        "#,
        &[
            case("sh forward negative.sp", 1, &["negative.sp:2", "-5", "the file has 2"]),
            case("sh forward endless.sp", 1, &["endless.sp:2", "the file has 2"]),
            case("sh forward lying.ti3", 1, &["lying.ti3:2", "4000000000", "1 row"]),
            case("sh forward tiny.sp", 1, &["is too large"]),
            case("sh forward nan.sp", 1, &["nan.sp:7", "SPEC_700", "'nan'"]),
            case("sh forward huge.sp", 1, &["is too large"]),
            case("sh forward short.txt", 1, &["short.txt:7", "2 values", "3 columns"]),
            case("sh forward device.ti3", 1, &["device.ti3:6", "no columns of spectra"]),
            case("sh forward narrow.sp", 1, &["450..700 nm", "400..700 nm"]),
            case("sh forward member.sp:b", 1, &["no column 'b'", "a"]),
            case("sh forward cut.sp", 1, &["cut.sp:6", "END_DATA is missing"]),
            case("sh forward film.sp", 1, &["film.sp", "transmittances, not reflectances"]),
            case("sh forward second.ti3", 1, &["second.ti3:13", "1 value,", "2 columns"]),
            case("sh forward twice.sp", 1, &["twice.sp:15", "two samples are called 'a'"]),
            case("sh forward quote.sp", 1, &["quote.sp:1", "not a CGATS table"]),
            case("sh forward binary.sp", 1, &["binary.sp"]),
            case("sh forward empty.ti3", 1, &["empty.ti3:1", "not a CGATS table"]),
            case("sh forward long.sp", 1, &["long.sp:1", "larger than 64 MiB"]),
            case("sh forward missing.sp", 1, &["missing.sp", "No such file"]),
        ],
    );
}

#[test]
fn tm_27_files() {
    assert_refused(
        r#"
        vkernel --facets 1x1 -o scene.json
        file() {
            printf '%s<IESTM2714 xmlns="http://www.ies.org/iestm2714"><SpectralDistribution>' "$1"
            printf '%s</SpectralDistribution></IESTM2714>' "$2"
        }
        at() { printf '<SpectralData wavelength="%s">%s</SpectralData>' "$1" "$2"; }
        file '<!DOCTYPE a [<!ENTITY b "bbbbbbbb"><!ENTITY c "&b;&b;&b;&b;">]>' "$(at 400 '&c;')" > bomb.spdx
        file '<!DOCTYPE a [<!ENTITY b SYSTEM "scene.json">]>' "$(at 400 '&b;')" > outside.spdx
        file '' "$(at 400 '&b;')$(at 700 0.2)" > entity.spdx
        file '' "$(at 400 NaN)$(at 700 0.2)" > nan.spdx
        file '' "$(at 400 1e308)$(at 700 0.2)" > huge.spdx
        file '' "$(at 700 0.1)$(at 400 0.2)" > falling.spdx
        file '' "$(at -400 0.1)$(at 700 0.2)" > negative.spdx
        file '' "$(at 400 0.1)" > single.spdx
        file '' "$(at 0.4 0.1)$(at 0.7 0.2)" > micrometres.spdx
        file '' "$(at 400 0.1)$(at 700 0.2)" | head -c 120 > cut.spdx
        file '' "$(head -c 3000000 /dev/zero | sed 's/\x0/<a>/g')" > deep.spdx
        file '' "$(head -c 3000000 /dev/zero | sed 's/\x0/<a\/>/g')" > many.spdx
        echo '<html><body/></html>' > page.spdx
        echo 'nm,r' > table.spdx
        { printf '\377\376'; file '' "$(at 400 0.1)" | sed 's/./&\x0/g'; } > utf16.spdx
        { printf '<IESTM2714 '; seq -f 'a%.0f="1"' 200000 | tr '\n' ' '; printf '/>'; } > attributes.spdx
        of() { file '' "<SpectralQuantity>$1</SpectralQuantity>$(at 400 0.1)$(at 700 0.2)" > "$2"; }
        of absorptance absorptance.spdx
        of transmittance transmittance.spdx
        of T-Factor factor.spdx
        of irradiance light.spdx
        of reflectance paint.spdx
        units() {
            {
                printf '{"spectral_data": {"units": "%s", "index": {"main": ["x"]}, ' "$1"
                printf '"data": {"main": {"400": [0.1], "700": [0.2]}}}}'
            } > "$2"
        }
        units absorptance absorptance.json
        units transmittance transmittance.json
        units reflectance paint.json
        : > empty.spdx
        truncate -s 70M long.spdx
        cat > forward <<'END'
        vforward scene.json --reflectance "$1"
END
        "#,
        &[
            case("sh forward bomb.spdx", 1, &["bomb.spdx:1", "DTD"]),
            case("sh forward outside.spdx", 1, &["outside.spdx:1", "DTD"]),
            case("sh forward entity.spdx", 1, &["entity.spdx:1", "entity"]),
            case("sh forward nan.spdx", 1, &["nan.spdx:1", "NaN"]),
            case("sh forward huge.spdx", 1, &["is too large"]),
            case("sh forward falling.spdx", 1, &["400 nm follows 700 nm"]),
            case("sh forward negative.spdx", 1, &["-400"]),
            case("sh forward single.spdx", 1, &["two wavelengths"]),
            case("sh forward micrometres.spdx", 1, &["looks like micrometres"]),
            case("sh forward cut.spdx", 1, &["cut.spdx:1", "not readable XML"]),
            case("sh forward deep.spdx", 1, &["deep.spdx:1", "64"]),
            case("sh forward many.spdx", 1, &["many.spdx:1", "nodes"]),
            case("sh forward page.spdx", 1, &["<html>", "IESTM2714"]),
            case("sh forward table.spdx", 1, &["table.spdx:1", "not readable XML"]),
            case("sh forward utf16.spdx", 1, &["utf16.spdx:1", "1 element <SpectralData>"]),
            case("sh forward attributes.spdx", 1, &["attributes.spdx:1", "more than 100 attributes"]),
            case("sh forward absorptance.spdx", 1, &["absorptance.spdx", "absorptances, not reflectances"]),
            case("sh forward transmittance.spdx", 1, &["transmittances, not reflectances"]),
            case("sh forward factor.spdx", 1, &["transmittances, not reflectances"]),
            case("sh forward light.spdx", 1, &["light.spdx", "the power of a light, not reflectances"]),
            case("sh forward absorptance.json", 1, &["absorptance.json", "absorptances, not reflectances"]),
            case("sh forward transmittance.json", 1, &["transmittances, not reflectances"]),
            case(
                "vforward scene.json --reflectance 0.5 --illuminant paint.spdx",
                1,
                &["paint.spdx", "reflectances, not the power of a light"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --camera paint.json",
                1,
                &["paint.json", "reflectances, not sensitivities of a camera"],
            ),
            case("sh forward empty.spdx", 1, &["empty.spdx:1", "not readable XML"]),
            case("sh forward long.spdx", 1, &["long.spdx:1", "larger than 64 MiB"]),
        ],
    );
}

#[test]
fn own_spectra() {
    assert_refused(
        r"
        vkernel --facets 1x1 -o scene.json
        mkdir own
        printf 'nm,r\n400,0.1\n700,0.3\n' > own/paint.csv
        cp own/paint.csv own/lamp.csv
        cp own/paint.csv own/lamp.txt
        printf 'nm,r\n400,NaN\n' > own/bad.csv",
        &[
            case(
                "VFOLD_DATA=none vforward scene.json --reflectance cc24",
                1,
                &["VFOLD_DATA none", "No such file"],
            ),
            case("VFOLD_DATA=scene.json vforward --list cameras", 1, &["VFOLD_DATA scene.json", "directory"]),
            case(
                "VFOLD_DATA=own vforward scene.json --reflectance lamp",
                1,
                &["lamp.csv and lamp.txt", "path"],
            ),
            case("VFOLD_DATA=own vforward scene.json --reflectance paint:g", 1, &["no column 'g'"]),
            case("VFOLD_DATA=own vforward scene.json --reflectance bad", 1, &["own/bad.csv:2"]),
            case("VFOLD_DATA=own vforward scene.json --reflectance pain", 1, &["did you mean paint?"]),
            case("VFOLD_DATA=own vforward scene.json --reflectance notes", 1, &["no reflectance"]),
            case("vforward scene.json --reflectance paint", 1, &["no reflectance is called 'paint'"]),
        ],
    );
}

#[test]
fn files_of_estimates() {
    assert_refused(
        r"
        vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:blue | vestimate -o two.ndjson
        vkernel --facets 2x2 -o scene.json
        vkernel --facets 2x2 | vforward --reflectance cc24:red --wavelengths-nm 400:700:10 | vestimate \
            | cat two.ndjson - > grids.ndjson",
        &[
            case("vestimate scene.json --spectra red.txt", 2, &["--spectra", "end it in .csv, .sp or .spdx"]),
            case("vestimate scene.json --spectra red", 2, &["end it in"]),
            case("vscore two.ndjson --spectra two.spdx", 1, &["2 samples", "holds one"]),
            case("head -n 1 two.ndjson | vestimate --spectra none.csv", 1, &["there is no estimate"]),
            case("vscore grids.ndjson --spectra grids.csv", 1, &["different wavelengths"]),
            case("vscore two.ndjson --spectra none/two.csv", 1, &["none/two.csv", "No such file"]),
        ],
    );
}

#[test]
fn scores() {
    assert_refused(
        r"
        vkernel --facets 2x2 | vforward --reflectance cc24:red | vestimate -o red.ndjson",
        &[
            case("vscore red.ndjson --metrics metamerism", 2, &["--metrics", "--illuminant A"]),
            case("vscore red.ndjson --metrics rmse,rmse", 2, &["'rmse' is requested twice"]),
            case("vscore red.ndjson --illuminant D65 --illuminant A --illuminant A", 2, &["twice"]),
            case("vscore red.ndjson --metrics beauty", 2, &["beauty"]),
            case("vscore red.ndjson --by truth.nme", 1, &["truth.nme", "no sample or scene has it"]),
            case("vscore red.ndjson --by estimate", 1, &["estimate", "not one value"]),
            case("vscore red.ndjson --table --colour", 2, &["--table"]),
        ],
    );
}
