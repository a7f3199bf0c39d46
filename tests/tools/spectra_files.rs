//! Files of spectra: what other programs write, in all their encodings and layouts, and colour-science and
//! Argyll CMS, who read and write them. Where one of those two is missing its tests pass without a check, and
//! `tests/run` says so.

use crate::common::Workdir;

/// What must be there to check against.
const COLOUR_SCIENCE: &str = "python3 -c 'import colour'";
const ARGYLL: &str = "command -v spec2cie";

/// Runs a script that must end well, if `needed` does.
fn check(needed: &str, script: &str) {
    let folder = Workdir::new();
    if !folder.can(needed, "reading what others write, and the other way round") {
        return;
    }
    let run = folder.sh(script);
    assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
}

/// The same table as programs write it in countries with a decimal point, with a decimal comma, and as it is
/// copied from them.
#[test]
fn separators_and_decimal_marks_change_nothing() {
    check(
        "true",
        r#"
        printf 'nm,red,"a, b"\n380,0.05,0.2\n550.5,0.1,0.2\n780,0.7,0.2\n' > commas.csv
        printf 'nm;red;a, b\r\n380;0,05;0,2\r\n550,5;0,1;0,2\r\n780;0,7;0,2\r\n' > semicolons.csv
        printf 'nm\tred\ta, b\n380\t"0,05"\t0,2\n550,5\t0,1\t0,2\n780\t0,7\t0,2\n' > tabs.csv
        vkernel --facets 1x1 -o scene.json
        for table in commas semicolons tabs; do
            vforward scene.json --reflectance $table.csv --save truth.reflectance=$table.npy -o $table.ndjson
            grep -q "\"id\":\"$table:a, b\"" $table.ndjson
        done
        cmp commas.npy semicolons.npy
        cmp commas.npy tabs.npy"#,
    );
}

#[test]
fn colour_science_reads_what_is_written() {
    check(
        COLOUR_SCIENCE,
        r#"
        vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:green \
            | vestimate --spectra two.csv -o two.ndjson
        head -n 2 two.ndjson | vscore --spectra red.spdx -o scored.ndjson
        cat > read.py <<'END'
import json, numpy
from colour import SpectralDistribution_IESTM2714, read_sds_from_csv_file
table = read_sds_from_csv_file("two.csv")
for record in map(json.loads, open("two.ndjson")):
    if record["kind"] == "sample":
        estimate = record["estimate"]
        for ending, field in ("", "reflectance"), ("_sd", "reflectance_sd"):
            column = table[record["id"] + ending]
            assert numpy.array_equal(column.wavelengths, estimate["wavelengths_nm"]), record["id"]
            assert numpy.allclose(column.values, estimate[field], rtol=1e-14, atol=0), record["id"]
red = SpectralDistribution_IESTM2714("red.spdx").read()
assert red.header.description == "cc24:red" and red.spectral_quantity == "reflectance"
assert numpy.allclose(red.values, table["cc24:red"].values, rtol=1e-14, atol=0)
assert numpy.array_equal(red.wavelengths, table["cc24:red"].wavelengths)
END
        python3 read.py"#,
    );
}

#[test]
fn what_colour_science_writes_is_read() {
    check(
        COLOUR_SCIENCE,
        r#"
        cat > write.py <<'END'
import colour
patch = colour.SDS_COLOURCHECKERS["ISO 17321-1"]["foliage"].copy().align(colour.SpectralShape(380, 780, 10))
colour.write_sds_to_csv_file({"foliage": patch}, "foliage.csv")
header = colour.io.Header_IESTM2714(
    description="leaf", document_creator="a test", document_creation_date="2026-01-31T12:00:00Z")
colour.SpectralDistribution_IESTM2714(
    "foliage.spdx", header, spectral_quantity="reflectance", data=patch).write()
fine = patch.copy().interpolate(colour.SpectralShape(400, 700, 1), interpolator=colour.SpragueInterpolator)
colour.write_sds_to_csv_file({"foliage": fine}, "fine.csv")
END
        python3 write.py
        vkernel --facets 1x1 -o scene.json
        for file in foliage.csv foliage.spdx; do
            vforward scene.json --reflectance $file --wavelengths-nm 400:700:1 | tail -n 1 > $file.ndjson
        done
        cat > compare.py <<'END'
import colour, json, numpy
fine = colour.read_sds_from_csv_file("fine.csv")["foliage"]
for file in "foliage.csv.ndjson", "foliage.spdx.ndjson":
    truth = json.load(open(file))["truth"]
    assert truth["interpolation"] == "sprague"
    assert numpy.array_equal(truth["wavelengths_nm"], fine.wavelengths)
    assert numpy.allclose(truth["reflectance"], fine.values, rtol=0, atol=1e-12), file
END
        python3 compare.py"#,
    );
}

/// Lines of a lamp on uneven wavelengths, and a table of ten samples that a spectrophotometer's program
/// wrote: both come with colour-science.
#[test]
fn files_of_others_are_read_as_by_colour_science() {
    check(
        &format!("{COLOUR_SCIENCE} && test -f $(python3 -c '{RESOURCES}')/Fluorescent.spdx"),
        &format!(
            r#"
        ln -s "$(python3 -c '{RESOURCES}')" resources
        vkernel --facets 1x1 | vforward --reflectance resources/X-Rite_Digital_Colour_Checker.txt \
            --illuminant resources/Fluorescent.spdx -o read.ndjson
        cat > compare.py <<'END'
import colour, json, numpy
records = list(map(json.loads, open("read.ndjson")))
lamp = colour.SpectralDistribution_IESTM2714("resources/Fluorescent.spdx").read()
light = records[0]["illuminants"][0]
assert light["interpolation"] == "average", light
fine_nm = numpy.arange(395, 705.001, 0.01)
fine = numpy.interp(fine_nm, lamp.wavelengths, lamp.values)
for nm, power in zip(records[0]["wavelengths_nm"], light["power"]):
    weights = numpy.maximum(0, 1 - abs(fine_nm - nm) / 5)
    mean = numpy.average(fine, weights=weights)
    # samples that are farther apart than wavebands are joined by lines
    apart = numpy.interp(nm, lamp.wavelengths, lamp.values)
    assert min(abs(power - mean), abs(power - apart)) < 1e-4 * mean, (nm, power, mean, apart)
total = numpy.trapezoid(fine[500:-500], dx=0.01)
assert abs(numpy.trapezoid(light["power"], dx=5) / total - 1) < 0.01
samples = colour.read_sds_from_xrite_file("resources/X-Rite_Digital_Colour_Checker.txt")
assert len(records) == 11 == len(samples) + 1
for record, sample in zip(records[1:], samples.values()):
    sprague = sample.copy().interpolate(
        colour.SpectralShape(400, 700, 5), interpolator=colour.SpragueInterpolator)
    assert numpy.allclose(record["truth"]["reflectance"], sprague.values, rtol=0, atol=1e-9), record["id"]
END
        python3 compare.py"#
        ),
    );
}

/// Lines of lamps count in full whatever the wavebands: colours of a grey sheet are those of wavebands of
/// 1 nm.
#[test]
fn lamps_have_one_colour_on_fine_and_coarse_wavebands() {
    let colours = |light: &str, step_nm: u32| -> [f64; 2] {
        let run = Workdir::new().sh(&format!(
            "vkernel --facets 1x1 | vforward --reflectance 0.5 --camera canon-5d-mark-ii \
                --illuminant {light} --wavelengths-nm 400:700:{step_nm} | tail -n 1"
        ));
        let sample: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
        let channel = |k: usize| sample["facet_rgb"][0][k].as_f64().unwrap();
        [0, 2].map(|k| channel(k) / channel(1))
    };
    for light in ["D65", "A", "FL2", "FL7", "FL11", "FL3.10", "LED-B3"] {
        let fine = colours(light, 1);
        for (step_nm, limit) in [(5, 0.005), (10, 0.005), (20, 0.04)] {
            let coarse = colours(light, step_nm);
            let off = [0, 1].map(|k| (coarse[k] / fine[k] - 1.0).abs());
            assert!(off.iter().all(|off| *off < limit), "{light}, {step_nm} nm: {off:?}");
        }
    }
}

const RESOURCES: &str =
    r#"import colour, os; print(os.path.join(os.path.dirname(colour.__file__), "io", "tests", "resources"))"#;

/// One table in every format and in every encoding that `iconv` of the GNU C library makes: the reflectances
/// are the same.
#[test]
fn encodings_and_line_ends_change_nothing() {
    check(
        "command -v iconv",
        r#"
        printf 'nm,r\303\251d\n380,0.05\n550,0.1\n780,0.7\n' > plain.csv
        printf '%s\n' CGATS.17 BEGIN_DATA_FORMAT 'SAMPLE_ID NM_380 NM_550 NM_780' END_DATA_FORMAT \
            BEGIN_DATA 'x 0.05 0.1 0.7' END_DATA > plain.txt
        cp plain.txt plain.sp
        printf '%s\n' '<?xml version="1.0"?>' \
            '<IESTM2714><SpectralDistribution><SpectralQuantity>reflectance</SpectralQuantity>' > plain.spdx
        for pair in 380:0.05 550:0.1 780:0.7; do
            echo "<SpectralData wavelength=\"${pair%:*}\">${pair#*:}</SpectralData>" >> plain.spdx
        done
        echo '</SpectralDistribution></IESTM2714>' >> plain.spdx
        printf '%s\n' '{"spectral_data": {"units": "reflectance", "index": {"main": ["x"]},' \
            '"data": {"main": {"380": [0.05], "550": [0.1], "780": [0.7]}}}}' > plain.json
        vkernel --facets 1x1 -o scene
        vforward scene --reflectance plain.csv --save truth.reflectance=wanted.npy -o wanted.ndjson
        for ending in csv txt sp spdx json; do
            mark=$(printf '\357\273\277')
            tr '\n' '\r' < plain.$ending > cr.$ending
            sed 's/$/\r/' plain.$ending > crlf.$ending
            { printf %s "$mark"; cat plain.$ending; } > mark.$ending
            { printf %s "$mark"; cat plain.$ending; } | iconv -f UTF-8 -t UTF-16LE > utf16le_mark.$ending
            { printf %s "$mark"; cat plain.$ending; } | iconv -f UTF-8 -t UTF-16BE > utf16be_mark.$ending
            iconv -f UTF-8 -t UTF-16LE plain.$ending > utf16le.$ending
            sed 's/$/\r/' plain.$ending | iconv -f UTF-8 -t UTF-16BE > utf16be.$ending
            for file in *.$ending; do
                vforward scene --reflectance $file --save truth.reflectance=found.npy -o found.ndjson
                cmp wanted.npy found.npy || { echo $file; exit 1; }
            done
        done
        vforward scene --reflectance utf16le.csv | grep -q '"id":"utf16le"'"#,
    );
}

/// What pandas (`to_csv`), R (`write.csv`) and spreadsheets put around a table: the reflectances are those of
/// the plain table.
#[test]
fn layouts_of_spreadsheets_and_data_frames_are_read() {
    check(
        "true",
        r#"
        printf 'nm,a,b\n380,0.05,0.2\n550,0.1,0.2\n780,0.7,0.2\n' > plain.csv
        printf 'sep=;\nnm;a;b\n380;0,05;0,2\n550;0,1;0,2\n780;0,7;0,2\n' > sep.csv
        printf '"sep=|"\r\nnm|a|b\r\n380|0.05|0.2\r\n550|0.1|0.2\r\n780|0.7|0.2\r\n' > bars.csv
        printf ',a,b\n380,0.05,0.2\n550,0.1,0.2\n780,0.7,0.2\n' > index.csv
        printf ',nm,a,b\n0,380,0.05,0.2\n1,550,0.1,0.2\n2,780,0.7,0.2\n' > pandas.csv
        printf '"","wavelength","a","b"\n"1",380,0.05,0.2\n"2",550,0.1,0.2\n"3",780,0.7,0.2\n' > r.csv
        printf '#,x,a,b\n1,380,0.05,0.2\n2,550,0.1,0.2\n3,780,0.7,0.2\n' > numbered.csv
        printf ',Wavelength [nm],a,b\n380,380,0.05,0.2\n381,550,0.1,0.2\n382,780,0.7,0.2\n' > sliced.csv
        printf 'wavelength,a,b\nnm,%%,\n380,5,0.2\n550,10,0.2\n780,70,0.2\n' > units.csv
        printf 'wavelength,a,b\num,-,-\n0.38,0.05,0.2\n0.55,0.1,0.2\n0.78,0.7,0.2\n' > micrometres.csv
        printf 'Wavelength (\303\205),a,b\n3800,0.05,0.2\n5500,0.1,0.2\n7800,0.7,0.2\n' > angstrom.csv
        printf '%s\n' 'nm,a,A std,b,b (uncertainty),a sd' 380,0.05,9,0.2,9,9 550,0.1,9,0.2,9,9 \
            780,0.7,9,0.2,9,9 | sed 's/A std/a std/' > deviations.csv
        vkernel --facets 1x1 -o scene.json
        vforward scene.json --reflectance plain.csv --save truth.reflectance=wanted.npy -o wanted.ndjson
        for file in sep bars index pandas r numbered sliced units micrometres angstrom deviations; do
            vforward scene.json --reflectance $file.csv \
                --save truth.reflectance=found.npy -o found.ndjson 2>said
            cmp wanted.npy found.npy || { echo $file; exit 1; }
            case $file in
                pandas|r|numbered|sliced) grep -q 'row numbers left out' said;;
                units) grep -q 'percent read as fractions' said;;
                angstrom) grep -q 'ngstr.*m read as nm' said;;
                deviations) grep -q 'standard deviations left out' said;;
                index|bars) test ! -s said;;
            esac
        done"#,
    );
}

/// The values are those that the program which made the files wrote them from.
#[test]
fn percent_and_line_ends_are_those_of_the_files() {
    check(
        "true",
        &format!(
            r#"
        at() {{
            sed -n 's/.*"truth".*"reflectance":\[\([^]]*\)\].*/\1/p' $1 |
                tr ',' '\n' | sed -n '1p;4p;7p' | tr '\n' ' '
        }}
        vkernel --facets 1x1 -o scene.json
        vforward scene.json --wavelengths-nm 400:700:50 \
            --reflectance {DATA}/dark_percent_numbered.csv -o dark.ndjson 2>said
        grep -q 'percent read as fractions' said
        vforward scene.json --wavelengths-nm 400:700:50 \
            --reflectance {DATA}/cgats_carriage_returns.txt -o cgats.ndjson
        test "$(at dark.ndjson | awk '{{ printf "%.4f %.4f %.4f", $1, $2, $3 }}')" = "0.0020 0.0034 0.0080"
        test "$(at cgats.ndjson | awk '{{ printf "%.4f %.4f %.4f", $1, $2, $3 }}')" = "0.1004 0.2157 0.5959""#
        ),
    );
}

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/spectra");

/// `--percent` for files that do not say it, and which values they have then.
#[test]
fn percent_is_what_the_flag_says_where_the_file_does_not() {
    check(
        "true",
        r#"
        printf 'nm,r\n400,1\n700,1.5\n' > between.csv
        printf 'nm,r\n400,0.25\n700,0.5\n' > small.csv
        printf 'nm,grey 50%%\n400,0.25\n700,0.5\n' > sign.csv
        printf '%s\n' CGATS.17 'SPECTRAL_NORM 1' BEGIN_DATA_FORMAT 'NM_400 NM_700' END_DATA_FORMAT \
            BEGIN_DATA '0.25 0.5' END_DATA > norm.txt
        vkernel --facets 1x1 -o scene.json
        ends() {
            vforward scene.json --wavelengths-nm 400:700:300 --reflectance "$@" 2>said |
                sed -n 's/.*"truth".*"reflectance":\[\([^]]*\)\].*/\1/p'
        }
        test "$(ends between.csv --percent)" = 0.01,0.015
        grep -q 'between.csv: percent read as fractions' said
        test "$(ends small.csv)" = 0.25,0.5
        test "$(ends small.csv --percent)" = 0.0025,0.005
        test "$(ends sign.csv --percent)" = 0.0025,0.005
        test "$(ends sign.csv --percent=no)" = 0.25,0.5
        test ! -s said
        test "$(ends norm.txt --percent)" = 0.25,0.5
        test "$(ends 0.5 --percent)" = 0.5,0.5"#,
    );
}

/// A file whose first table has the colours and whose second has the spectra, and one with spectra in both.
#[test]
fn spectra_may_be_in_a_second_table() {
    check(
        "true",
        r#"
        table() { printf 'BEGIN_DATA_FORMAT\n%s\nEND_DATA_FORMAT\nBEGIN_DATA\n%b\nEND_DATA\n' "$1" "$2"; }
        { echo CGATS.17; table 'SAMPLE_ID RGB_R RGB_G' 'a 1 2\nb 3 4'; echo 'SPECTRAL_NORM 100'
          table 'SAMPLE_ID NM_400 NM_700' 'a 25 50\nb 75 12.5'; } > second.txt
        { echo CGATS.17; table 'SAMPLE_ID NM_400 NM_700' 'a 0.25 0.5'
          table 'SAMPLE_ID NM_400 NM_500 NM_700' 'b 0.75 0.5 0.125'
          echo '# end'; } > both.txt
        vkernel --facets 1x1 -o scene.json
        ends() {
            vforward scene.json --wavelengths-nm 400:700:300 --reflectance "$1" |
                sed -n 's/.*"truth".*"reflectance":\[\([^]]*\)\].*/\1/p'
        }
        test "$(ends second.txt)" = "$(printf '0.25,0.5\n0.75,0.125')"
        test "$(ends both.txt)" = "$(printf '0.25,0.5\n0.75,0.125')""#,
    );
}

/// `colour.sd_blackbody`, colour-science 0.4.7, whose constants are those of 2018 as well.
#[test]
fn black_bodies_are_those_of_colour_science() {
    check(
        COLOUR_SCIENCE,
        r#"
        vkernel --facets 1x1 -o scene.json
        for kelvin in 1500 2856 5500 12000; do
            vforward scene.json --reflectance 0.5 --illuminant ${kelvin}K -o $kelvin.ndjson
        done
        cat > compare.py <<'END'
import colour, json, numpy
for kelvin in 1500, 2856, 5500, 12000:
    scene = json.loads(open(f"{kelvin}.ndjson").readline())
    theirs = colour.sd_blackbody(kelvin, colour.SpectralShape(400, 700, 5)).values
    ours = numpy.array(scene["illuminants"][0]["power"])
    assert scene["illuminants"][0]["name"] == f"{kelvin}K"
    assert numpy.allclose(ours / ours[32], theirs / theirs[32], rtol=1e-5), \
        (kelvin, ours / ours[32] * theirs[32] / theirs)
END
        python3 compare.py"#,
    );
}

/// Names that a spreadsheet would run, that turn the writing or that look like a unit: none is in what is
/// written, and all come back.
#[test]
fn written_tables_are_safe_to_open() {
    check(
        "true",
        r#"
        escape=$(printf '\033') turned=$(printf '\342\200\256')
        {
            printf 'nm,"=HYPERLINK(""x"")",+1,-2,@sum,%s[2J,%sder\n' "$escape" "$turned"
            printf '400,0.1,0.2,0.3,0.4,0.5,0.6\n700,0.1,0.2,0.3,0.4,0.5,0.6\n'
        } > evil.csv
        vkernel --facets 2x2 | vforward --reflectance evil.csv |
            sed 's/"id":"evil:/"id":"/' | vestimate --spectra written.csv -o estimates.ndjson
        if grep -q "$escape\|$turned" written.csv; then exit 1; fi
        if head -n 1 written.csv | tr ',' '\n' | grep -q '^"*[-=+@]'; then exit 1; fi
        vkernel --facets 1x1 | vforward --reflectance written.csv 2>/dev/null \
            | sed -n 's/.*"id":"written:\(.*\)","facet_rgb".*/\1/p' > again
        grep -qxF '=HYPERLINK(_x_)' again
        grep -qxF -e +1 again
        grep -qxF -e -2 again
        grep -qxF '@sum' again
        test "$(wc -l < again)" = 6"#,
    );
}

/// Samples whose names no column can have, or that readers would trim to one.
#[test]
fn written_tables_are_read_whatever_the_samples_are_called() {
    check(
        "true",
        r#"
        vkernel --facets 2x2 | vforward --reflectance 0.2 0.3 0.4 0.5 0.6 -o plain.ndjson
        sed 's/"id":"0.2"/"id":""/; s/"id":"0.3"/"id":"wavelength_nm"/; s/"id":"0.4"/"id":"  "/
            s/"id":"0.5"/"id":"b"/; s/"id":"0.6"/"id":"b "/' plain.ndjson > samples.ndjson
        vestimate samples.ndjson --spectra written.csv -o estimates.ndjson
        vestimate samples.ndjson --spectra written.sp -o again.ndjson
        for file in csv sp; do
            vkernel --facets 1x1 | vforward --reflectance written.$file 2>/dev/null \
                | sed -n 's/.*"id":"written:\(.*\)","facet_rgb".*/\1/p' > names.$file
        done
        printf '%s\n' sample 'wavelength_nm (2)' 'sample (2)' b 'b (2)' | cmp - names.csv
        cmp names.csv names.sp"#,
    );
}

/// Headings by which instruments call the standard deviation of the column before them, or of all.
#[test]
fn columns_of_standard_deviations_are_no_spectra() {
    check(
        "true",
        r#"
        vkernel --facets 1x1 -o scene.json
        for name in SD 'Std Dev' 'Std. Dev.' StdDev 'Standard deviation' 'red Std Dev' \
            'red (standard error)' red_std_dev 'red SD'; do
            printf 'nm,red,%s,white\n380,0.1,9,0.9\n780,0.1,9,0.9\n' "$name" > some.csv
            vforward scene.json --reflectance some.csv 2>said | grep -c '"id":"some:' | grep -qx 2 ||
                { echo "$name"; exit 1; }
            grep -q 'standard deviations left out' said
        done
        printf 'nm,SD card,blue\n380,0.1,0.9\n780,0.1,0.9\n' > card.csv
        vforward scene.json --reflectance card.csv | grep -q '"id":"card:SD card"'
        printf 'nm,sd\n380,0.1\n780,0.1\n' > alone.csv
        vforward scene.json --reflectance alone.csv | grep -q '"id":"alone"'"#,
    );
}

/// XYZ that Argyll computes from the file, D50 and the 2° observer; it sums bands of 5 nm with tables of its
/// own.
#[test]
fn argyll_reads_what_is_written() {
    check(
        ARGYLL,
        r#"
        vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:green |
            vestimate --spectra two.sp | vscore --colour --illuminant D50 --observer 2 -o two.ndjson
        spec2cie -i D50 -o 1931_2 two.sp cie.sp >/dev/null
        awk '/^END_DATA/ { rows = 0 } rows { print $1, $(NF-5), $(NF-4), $(NF-3) }
            /^BEGIN_DATA$/ { rows = 1 }' cie.sp > argyll.txt
        cat > compare.py <<'END'
import json
argyll = {row.split()[0].strip('"'): [float(x) for x in row.split()[1:]] for row in open("argyll.txt")}
samples = [record for record in map(json.loads, open("two.ndjson")) if record["kind"] == "sample"]
assert len(samples) == len(argyll) == 2, argyll
for sample in samples:
    for ours, theirs in zip(sample["colour"]["xyz"], argyll[sample["id"]]):
        assert abs(ours - theirs) < 0.005 * ours + 0.02, (sample["id"], sample["colour"]["xyz"], argyll)
END
        python3 compare.py"#,
    );
}

/// Its daylight of 5000 K and ours.
#[test]
fn argylls_own_files_are_read() {
    check(
        "test -f /usr/share/color/argyll/ref/D50_1.0.sp",
        r#"
        for light in /usr/share/color/argyll/ref/D50_1.0.sp D50; do
            vkernel --facets 1x1 | vforward --reflectance 0.5 --illuminant $light | head -n 1
        done > scenes.ndjson
        cat > compare.py <<'END'
import json
theirs, ours = (json.loads(line)["illuminants"][0]["power"] for line in open("scenes.ndjson"))
scale = theirs[32] / ours[32]
assert all(abs(a - scale * b) < 0.01 * scale * b for a, b in zip(theirs, ours)), \
    max(a / b for a, b in zip(theirs, ours))
END
        python3 compare.py"#,
    );
}
