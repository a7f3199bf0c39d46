//! Files of spectra against others who read and write them: colour-science and Argyll CMS. Where one of them is missing its tests pass
//! without a check, and `tests/run` says so.

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

/// The same table as programs write it in countries with a decimal point, with a decimal comma, and as it is copied from them.
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
        vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:green | vestimate --spectra two.csv -o two.ndjson
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
header = colour.io.Header_IESTM2714(description="leaf", document_creator="a test", document_creation_date="2026-01-31T12:00:00Z")
colour.SpectralDistribution_IESTM2714("foliage.spdx", header, spectral_quantity="reflectance", data=patch).write()
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

/// Lines of a lamp on uneven wavelengths, and a table of ten samples that a spectrophotometer's program wrote: both come with
/// colour-science.
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
assert light["interpolation"] == "linear", light
assert numpy.allclose(light["power"], numpy.interp(records[0]["wavelengths_nm"], lamp.wavelengths, lamp.values), rtol=1e-12)
samples = colour.read_sds_from_xrite_file("resources/X-Rite_Digital_Colour_Checker.txt")
assert len(records) == 11 == len(samples) + 1
for record, sample in zip(records[1:], samples.values()):
    sprague = sample.copy().interpolate(colour.SpectralShape(400, 700, 5), interpolator=colour.SpragueInterpolator)
    assert numpy.allclose(record["truth"]["reflectance"], sprague.values, rtol=0, atol=1e-9), record["id"]
END
        python3 compare.py"#
        ),
    );
}

const RESOURCES: &str =
    r#"import colour, os; print(os.path.join(os.path.dirname(colour.__file__), "io", "tests", "resources"))"#;

/// XYZ that Argyll computes from the file, D50 and the 2° observer; it sums bands of 5 nm with tables of its own.
#[test]
fn argyll_reads_what_is_written() {
    check(
        ARGYLL,
        r#"
        vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:green |
            vestimate --spectra two.sp | vscore --colour --illuminant D50 --observer 2 -o two.ndjson
        spec2cie -i D50 -o 1931_2 two.sp cie.sp >/dev/null
        awk '/^END_DATA/ { rows = 0 } rows { print $1, $(NF-5), $(NF-4), $(NF-3) } /^BEGIN_DATA$/ { rows = 1 }' cie.sp > argyll.txt
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
assert all(abs(a - scale * b) < 0.01 * scale * b for a, b in zip(theirs, ours)), max(a / b for a, b in zip(theirs, ours))
END
        python3 compare.py"#,
    );
}
