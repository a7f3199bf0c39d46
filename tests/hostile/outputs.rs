//! Where records, arrays and drawings go: each to a file of its own, and to none that is not one.

use crate::common::Workdir;
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
                &["outputs", "two of this run would go to x", "a name of its own"],
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
                "vforward scene.json --reflectance 0.5 --save facet_rgb=x --save id=y --save truth.reflectance=x",
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
            case("vkernel -o loop", 1, &["loop", "a link that leads to no file"]),
            case("vkernel -o dangling", 1, &["dangling", "a link that leads to no file"]),
            case("vkernel --save kernel=dangling", 1, &["dangling", "a link that leads to no file"]),
        ],
    );
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
        &[case("ulimit -v 400000; vkernel -j 1024 --facets 2x2", 1, &["so many threads", "--threads"])],
    );
}
