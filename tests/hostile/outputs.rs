//! Where records, arrays and drawings go: each to a file of its own, and to none that is not one.

use crate::common::Workdir;
use crate::ready::{ready, sh};
use crate::{assert_refused, case};

#[test]
fn names_of_outputs() {
    assert_refused(
        "
        vkernel --facets 2x2 -o scene.json
        vforward scene.json --reflectance 0.5 -o samples.ndjson
        ln -s loop loop
        ln -s nowhere dangling
        ln -s samples.ndjson link
        mkdir folder
        ",
        &[
            case(
                "vforward scene.json --reflectance 0.5 -o x --save facet_rgb=x",
                2,
                &["outputs", "two would be written to x", "its own name"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 -o folder/x --save facet_rgb=folder/../folder/x",
                2,
                &["outputs"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 -o samples.ndjson --save facet_rgb=link",
                2,
                &["outputs"],
            ),
            case(
                "vforward scene.json --reflectance 0.5 --save facet_rgb=x --save id=y \
                    --save truth.reflectance=x",
                2,
                &["outputs"],
            ),
            case("vforward scene.json --reflectance 0.5 -o x.exr --render x.exr", 2, &["outputs"]),
            case("vestimate samples.ndjson -o x.svg --plot x.svg", 2, &["outputs"]),
            case("vestimate samples.ndjson -o x --trace x", 2, &["outputs"]),
            case("vestimate samples.ndjson -o x.csv --spectra x.csv", 2, &["outputs"]),
            case(
                "vforward scene.json --reflectance 0.5 --resume samples.ndjson --save facet_rgb=link",
                1,
                &["samples.ndjson"],
            ),
            case("vkernel -o loop", 1, &["loop", "a link to a missing file"]),
            case("vkernel -o dangling", 1, &["dangling", "a link to a missing file"]),
            case("vkernel --save kernel=dangling", 1, &["dangling", "a link to a missing file"]),
        ],
    );
}

/// All outputs of a run appear together when it has ended well, so that one that fails replaces none and adds
/// none, whichever of them fails, and when.
#[test]
fn a_failing_run_changes_no_output() {
    let folder = ready();
    let setup = "head -n 1 samples.ndjson > empty.ndjson; \
        for file in old old.svg old.npy; do echo old > $file; \
        done; ls -A; cat old*";
    let before = sh(&folder, setup).stdout;
    for run in [
        "vestimate empty.ndjson --plot old.svg -o old",
        "vscore empty.ndjson --plot new.svg -o old",
        "vscore empty.ndjson --report new.html --save rmse=old.npy",
        "vestimate -q samples.ndjson --save nothing=old.npy --plot old.svg --trace new -o old \
            --spectra new.csv",
        "vestimate -q samples.ndjson --plot old.svg --trace old --save reflectance=old.npy > /dev/full",
        "vscore estimates.ndjson --save nothing=old.npy --report new.html --plot old.svg -o old",
        "vkernel --facets 2x2 --plot old.svg --save kernel=old.npy > /dev/full",
        "vforward -q scene.json --reflectance 0.5 --render new.exr --save nothing=old.npy -o old",
        "extract -q photo.exr --overlay new.png --save nothing=old.npy -o old",
    ] {
        let after = sh(&folder, &format!("{{ {run}; }} > /dev/null || echo $? >&2; ls -A; cat old*"));
        assert!(after.stderr.ends_with("\n1\n"), "{run}: {after:?}");
        assert_eq!(after.stdout, before, "{run}");
    }
}

/// Samples that carry an error say why there is nothing to draw, and are kept.
#[test]
fn records_that_say_why_nothing_is_drawn_are_kept() {
    let folder = ready();
    let run = "sed 's/facet_rgb/facets/' samples.ndjson | vestimate --plot new.svg -o new || echo $?; \
        ls new*; \
        grep -c '\"error\"' new";
    assert_eq!(sh(&folder, run).stdout, "3\nnew\n24\n");
}

/// Where the corners of a photograph are is said once its sample is out.
#[test]
fn nothing_is_said_of_what_fails() {
    let folder = Workdir::new();
    let run = folder.sh("vkernel --facets 2x2 | vforward --reflectance 0.5 --render x.exr > /dev/full");
    assert_eq!((run.status, run.stderr.lines().count()), (1, 1), "{}", run.stderr);
    assert!(run.stderr.starts_with("vforward: standard output: "), "{}", run.stderr);
}

/// A tool that gets no threads says so.
#[test]
fn threads_that_cannot_be_had() {
    assert_refused(
        "",
        &[
            case(
                "ulimit -v 400000; vkernel -j 1024 --facets 2x2",
                1,
                &["a run on 1024 threads", "--threads"],
            ),
            case(
                "RAYON_NUM_THREADS=9999999999999999 vkernel --facets 2x2",
                1,
                &["a run on 9999999999999999 threads", "--threads"],
            ),
        ],
    );
}

/// A name is bytes: one that is no UTF-8 is written as it is, and said as far as it can be.
#[test]
fn names_that_are_no_utf_8() {
    let folder = Workdir::new();
    let run = folder.sh("name=$(printf 'x\\377')
        vkernel --facets 2x2 -o \"$name.json\"
        vforward \"$name.json\" --reflectance cc24:red || echo $?
        vforward --reflectance cc24:red -q --render \"$name.exr\" -o \"$name.ndjson\" < \"$name.json\"
        vestimate --resume \"$name.estimates\" --spectra \"$name.csv\" < \"$name.ndjson\"
        vscore -o \"$name.scores\" < \"$name.estimates\"
        ls | LC_ALL=C sed 's/x[^.]*/x/'");
    assert_eq!(run.stdout, "2\nx.csv\nx.estimates\nx.exr\nx.json\nx.ndjson\nx.scores\n", "{run:?}");
    assert!(run.status == 0 && run.stderr.lines().count() == 1 && run.stderr.contains("UTF-8"), "{run:?}");
}

/// With as few files as may be open at once a run ends as it should, or says in one line that there are too
/// many.
#[test]
fn few_files_may_be_open() {
    let folder = Workdir::new();
    folder.sh("vkernel --facets 2x2 -o scene; vforward scene --reflectance cc24:red -o samples; \
        vestimate samples -o estimates");
    for files in 4..9 {
        for line in [
            "vkernel --facets 2x2 -o out --save kernel=k.npy --plot k.svg",
            "vforward -q scene --reflectance cc24:red -o out --render r.exr",
            "vestimate samples -o out --spectra a.csv --plot a.svg --trace t --save facet_rgb=f.npy",
            "vestimate samples --resume again",
            "vscore estimates --report r.html --plot x.png --save metrics.rmse=f.npy",
        ] {
            let run = folder.sh(&format!("exec > /dev/null; ulimit -n {files}; exec {line}"));
            let is_said = run.stderr.lines().count() == 1 && run.stderr.contains("Too many open files");
            let is_done = run.status == 0 && run.stderr.is_empty();
            assert!(is_done || (run.status == 1 && is_said), "{files} {line}: {run:?}");
        }
    }
}
