//! examples/python reads what the tools write, and colour-science judges it as vscore does.

use crate::common::Workdir;

const SCRIPT: &str = concat!(
    "script='",
    env!("CARGO_MANIFEST_DIR"),
    "/examples/python/read_stream.py'\n",
    "vkernel | vforward --reflectance cc24 --noise-sd 1e-3 |\n",
    "    vestimate --save estimate.reflectance=spectra.npy -o estimates.ndjson\n",
    "python3 \"$script\" estimates.ndjson spectra.npy spectra.png\n",
    "vscore estimates.ndjson --table | sed -n '2,25p'\n",
    "oiiotool --info spectra.png >&2\n",
);

/// Numbers of a line after its name of 28 characters.
fn numbers(line: &str) -> Vec<f64> {
    line[28..].split_whitespace().map(|number| number.parse().unwrap()).collect()
}

#[test]
fn colour_science_reads_the_stream() {
    let folder = Workdir::new();
    if !folder.can("python3 -c 'import matplotlib, colour'", "examples/python") {
        return;
    }
    let run = folder.sh(SCRIPT);
    assert_eq!(run.status, 0, "{run:?}");
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(lines.len(), 48, "{run:?}");
    for (python, vscore) in lines[..24].iter().zip(&lines[24..]) {
        assert_eq!(python[..28], vscore[..28]);
        let (theirs, ours) = (numbers(python), numbers(vscore));
        assert!((theirs[0] - 45.0).abs() < 1e-9 && (theirs[1] - ours[0]).abs() < 1e-4, "{python} {vscore}");
        // three decimals are printed
        assert!((theirs[2] - ours[1]).abs() < 0.002, "{python} {vscore}");
    }
    assert!(run.stderr.contains("spectra.png"), "{run:?}");
}
