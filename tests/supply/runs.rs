//! What a run leaves behind, and how much memory it takes.

use super::common::Workdir;
use super::path;

/// Every tool once, with all that it can be asked to write; homes and folders for temporary files are there
/// to be looked into.
const ALL_TOOLS: &str = "
mkdir home tmp work
export HOME=$PWD/home TMPDIR=$PWD/tmp XDG_CONFIG_HOME=$PWD/home/c XDG_CACHE_HOME=$PWD/home/k \
    XDG_DATA_HOME=$PWD/home/d
cd work
vkernel --angle-deg 50 --facets 4x4 --save kernel=k.npy -o scene.json
vforward scene.json --reflectance cc24:red cc24:green --noise-sd 1e-3 --render fold.png -o samples.ndjson
vextract \"$PHOTO\" --scene scene.json --camera canon-5d-mark-ii --illuminant D65 \
    --overlay overlay.png -o sample.ndjson \\
    --panel0 '332,462 345,77 122,12 104,442' --panel1 '332,462 345,77 485,17 472,446'
vestimate samples.ndjson --plot spectra.svg --resume estimates.ndjson
vestimate sample.ndjson --trace trace.ndjson -o estimate.ndjson
vscore estimates.ndjson --spectra spectra.csv --plot scores.svg --colour -o scores.ndjson
cd ..
find . -type f | sort
";

const WRITTEN: &str = "\
./work/estimate.ndjson
./work/estimates.ndjson
./work/fold.png
./work/k.npy
./work/overlay.png
./work/sample.ndjson
./work/samples.ndjson
./work/scene.json
./work/scores.ndjson
./work/scores.svg
./work/spectra.csv
./work/spectra.svg
./work/trace.ndjson
";

#[test]
fn nothing_is_left_but_what_was_asked_for() {
    let photo = path("tests/data/photos/a_ideal_magenta_50.exr");
    let run = Workdir::new().sh(&format!("PHOTO='{}'{ALL_TOOLS}", photo.display()));
    assert_eq!((run.status, run.stdout.as_str()), (0, WRITTEN), "{}", run.stderr);
}

/// 300 MB of samples go through a tool that may have 200 MB of addresses, threads and program included. One
/// arena: those of glibc reserve 128 MB of addresses each, and where they cannot, every allocation is a call
/// of the system.
#[test]
fn streams_are_longer_than_memory() {
    let run = Workdir::new().sh("
        vkernel | vforward --reflectance cc24:red --noise-sd 1e-3 | vestimate -o one.ndjson
        sample=$(tail -n 1 one.ndjson)
        count=$((300000000 / ${#sample}))
        { head -n 1 one.ndjson; yes \"$sample\" | head -n $count; } \
            | (ulimit -v 200000; MALLOC_ARENA_MAX=1 vscore -j 2) | tail -n 1 > summary
        grep -q '\"scored\":'$count, summary");
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{run:?}");
}
