//! `share/python/vfold.py` reads what the tools write and measures what they measure, and colour-science
//! judges it as vscore does.

use crate::common::Workdir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Numbers of a line after its name of 28 characters.
fn numbers(line: &str) -> Vec<f64> {
    line[28..].split_whitespace().map(|number| number.parse().unwrap()).collect()
}

/// What Python prints that imports the module, in a folder with a photograph.
fn python(folder: &Workdir, script: &str) -> String {
    let photo = format!("{ROOT}/tests/data/photos/a_ideal_magenta_50.exr");
    let run = folder.sh(&format!(
        "cp '{photo}' photo.exr; PYTHONPATH='{ROOT}/share/python' PYTHONDONTWRITEBYTECODE=1 \
            python3 -W error - <<'END'
import vfold
import numpy as np

def refused(error, call):
    try:
        call()
    except error as problem:
        print(problem)
    else:
        raise AssertionError('nothing is wrong')

CANON = dict(camera='canon-5d-mark-ii', illuminant='D65')
{script}
END"
    ));
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{run:?}");
    run.stdout
}

#[test]
fn the_notebook_runs() {
    let folder = Workdir::new();
    if !folder.can("python3 -c 'import matplotlib, colour'", "examples/python") {
        return;
    }
    let run = folder.sh(&format!(
        "python3 '{ROOT}/examples/python/measure.py' . > printed; head -n 5 printed; tail -n 24 printed
        vscore patches.ndjson --table | sed -n '2,25p'; oiiotool --info spectrum.png patches.png >&2"
    ));
    assert_eq!(run.status, 0, "{run:?}");
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(lines.len(), 53, "{run:?}");
    for (line, beginning) in lines.iter().zip([
        "refused: vextract: --camera",
        "good: ",
        "corners found, 99",
        "CIELAB [",
        "24 sheets, 0 ",
    ]) {
        assert!(line.starts_with(beginning), "{line}");
    }
    for (python, vscore) in lines[5..29].iter().zip(&lines[29..]) {
        assert_eq!(python[..28], vscore[..28]);
        let (theirs, ours) = (numbers(python), numbers(vscore));
        assert!((theirs[0] - ours[0]).abs() < 1e-4, "{python} {vscore}");
        // three decimals are printed
        assert!((theirs[1] - ours[1]).abs() < 0.002, "{python} {vscore}");
    }
    assert!(run.stderr.contains("spectrum.png") && run.stderr.contains("patches.png"), "{run:?}");
}

#[test]
fn the_module_measures_what_the_tools_measure() {
    let folder = Workdir::new();
    let printed = python(
        &folder,
        "
sheet = vfold.measure('photo.exr', **CANON)
assert sheet.verdict == 'good' and sheet.because and sheet.name == 'photo', sheet
assert sheet.record['image']['detection_confidence'] > 0.97 and not sheet.notes
found = vfold.find('photo.exr')
again = vfold.measure('photo.exr', regions=found, **CANON)
assert np.array_equal(sheet.reflectance, again.reflectance)
given = vfold.measure('photo.exr', angle_deg=50, panel0=found['panel0'], panel1=np.array(found['panel1']), \
    wavelengths_nm=(400, 700, 10), **CANON)
assert given.wavelengths_nm.tolist() == list(range(400, 701, 10))
assert abs(given.reflectance - sheet.reflectance[::2]).max() < 0.05
assumed = vfold.measure('photo.exr', camera=CANON['camera'], fit=['exposure', 'angle'])
assert any('daylight assumed' in note for note in assumed.notes), assumed.notes
print(*sheet.wavelengths_nm, sep=',')
print(*sheet.reflectance.tolist(), sep=',')
print(*sheet.reflectance_sd.tolist(), sep=',')",
    );
    let tools = folder.sh("vextract --find photo.exr > found.json
        vkernel --regions found.json | vextract photo.exr --regions found.json \
            --camera canon-5d-mark-ii --illuminant D65 |
            vestimate --spectra spectrum.csv > result.ndjson; tail -n +2 spectrum.csv");
    assert_eq!((tools.status, tools.stderr.as_str()), (0, ""));
    let rows: Vec<Vec<f64>> =
        printed.lines().map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect();
    for (n, line) in tools.stdout.lines().enumerate() {
        let told: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        assert_eq!(told, [rows[0][n], rows[1][n], rows[2][n]], "{line}");
    }
    assert_eq!(tools.stdout.lines().count(), rows[0].len());
}

#[test]
fn the_module_raises_what_a_tool_says() {
    let printed = python(
        &Workdir::new(),
        "
refused(vfold.Error, lambda: vfold.measure('photo.exr'))
refused(vfold.Error, lambda: vfold.measure('none.exr', **CANON))
refused(vfold.Error, lambda: vfold.measure('photo.exr', camera='canon-5d-mk2'))
refused(vfold.Error, lambda: vfold.measure('photo.exr', \
    regions={'found': False, 'reason': 'there is no sheet'}, **CANON))
refused(TypeError, lambda: vfold.measure('photo.exr', cam='canon-5d-mark-ii'))
refused(TypeError, lambda: vfold.measure('photo.exr', panel0=[[1, 2]] * 4, **CANON))
refused(TypeError, lambda: vfold.measure('photo.exr', angle_deg=50, panel0=[1, 2, 3], **CANON))
import os
os.environ['PATH'] = ''
refused(vfold.Error, lambda: vfold.measure('photo.exr'))",
    );
    let beginnings = [
        "vextract: --camera: the photograph names no camera",
        "vextract: none.exr: No such file",
        "vextract: no camera is called 'canon-5d-mk2'",
        "vkernel: photo.exr: there is no sheet",
        "measure() does not know cam; it takes angle_deg,",
        "panel0 and panel1 do not state the angle",
        "panel0: four corners of two numbers are needed, not shape (3,)",
        "vextract is not on PATH",
    ];
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines.len(), beginnings.len(), "{printed}");
    for (line, beginning) in lines.iter().zip(beginnings) {
        assert!(line.starts_with(beginning), "{line}");
    }
}

/// A flag that a tool has no more would be a keyword that fails.
#[test]
fn keywords_are_flags_of_the_tools() {
    python(
        &Workdir::new(),
        "
import subprocess
for tool, names in vfold.KNOWN.items():
    words = subprocess.run([tool, '--help'], capture_output=True, text=True, check=True).stdout.split()
    flags = {word.split('[')[0].split('=')[0] for word in words}
    missing = [name for name in names if '--' + name.replace('_', '-') not in flags]
    assert not missing, (tool, missing)",
    );
}

#[test]
fn the_module_reads_records_tables_and_arrays() {
    let folder = Workdir::new();
    let made =
        folder.sh("vkernel --facets 3x3 | vforward --reflectance cc24 --noise-sd 1e-3 > samples.ndjson
        sed '3s/\"facet_rgb\":/\"no_facets\":/' samples.ndjson |
            { vestimate --spectra s.csv --save estimate.reflectance=s.npy -o e.ndjson 2> said || [ $? = 3 ]; }
        vscore e.ndjson -o scores.ndjson 2> said || [ $? = 3 ]");
    assert_eq!((made.status, made.stderr.as_str()), (0, ""));
    python(
        &folder,
        "
stream = vfold.read_stream('scores.ndjson')
assert len(stream.sheets) == 23 and len(stream.failures) == 1 and stream.summary['scored'] == 23, \
    stream.failures
table = vfold.read_spectra('s.csv')
assert [one.name for one in table] == [one.name for one in stream.sheets]
array = vfold.read_npy('s.npy')
array = array[np.isfinite(array).all(axis=1)]
for sheet, column, row in zip(stream.sheets, table, array, strict=True):
    assert np.array_equal(sheet.reflectance, column.reflectance) and np.array_equal(sheet.reflectance, row)
    assert np.array_equal(sheet.reflectance_sd, column.reflectance_sd) and \
        np.array_equal(sheet.wavelengths_nm, column.wavelengths_nm)
    rmse = np.sqrt(np.mean((sheet.reflectance - sheet.truth) ** 2))
    assert abs(rmse - sheet.record['metrics']['rmse']) < 1e-9, sheet.name
assert [record['kind'] for record in vfold.records('samples.ndjson')] == ['scene'] + ['sample'] * 24
from pathlib import Path
Path('no.csv').write_text('x')
refused(ValueError, lambda: vfold.read_spectra('no.csv'))
Path('no.csv').write_text('nm,a\\n400,x\\n')
refused(ValueError, lambda: vfold.read_spectra('no.csv'))",
    );
}

#[test]
fn spectra_go_to_colour_science() {
    let folder = Workdir::new();
    if !folder.can("python3 -c 'import colour'", "share/python with colour-science") {
        return;
    }
    let made = folder.sh("vkernel --facets 2x2 | vforward --reflectance cc24:red | vestimate -o e.ndjson");
    assert_eq!((made.status, made.stderr.as_str()), (0, ""));
    python(
        &folder,
        "
import sys, warnings
assert 'colour' not in sys.modules, 'colour-science is imported only where it is asked for'
warnings.simplefilter('ignore')
(sheet,) = vfold.read_stream('e.ndjson').sheets
spectrum = sheet.spectral_distribution()
assert spectrum.name == 'cc24:red' and np.array_equal(spectrum.values, sheet.reflectance)
assert np.array_equal(spectrum.wavelengths, sheet.wavelengths_nm)",
    );
}
