//! Records of all five tools fit the schemas that `--generate schema` prints, and spoilt ones do not;
//! jsonschema for Python judges.

use crate::common::Workdir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Every field that the schemas know is in some record.
#[test]
fn what_the_tools_write_fits_the_schema() {
    let folder = Workdir::new();
    if !folder.can("python3 -c 'import jsonschema'", "schemas against real records") {
        return;
    }
    let written = folder.sh(include_str!("schema/streams.sh"));
    assert_eq!((written.status, written.stderr.as_str()), (0, ""), "{written:?}");
    let judged = folder.sh(&format!(
        "vscore --generate schema > schema.json; \
            python3 '{ROOT}/tests/manual/schema/validate.py' schema.json *.ndjson"
    ));
    assert_eq!((judged.status, judged.stderr.as_str()), (0, ""), "{judged:?}");
    println!("{}", judged.stdout);
    for kind in ["scene", "sample", "summary", "plan", "iteration"] {
        assert!(judged.stdout.contains(kind), "no {kind} was written: {}", judged.stdout);
    }
}

#[test]
fn all_tools_print_the_same_schema() {
    let folder = Workdir::new();
    let [first, others @ ..] = ["vkernel", "vforward", "vextract", "vestimate", "vscore"]
        .map(|tool| folder.sh(&format!("{tool} --generate schema")).stdout);
    assert!(others.iter().all(|other| *other == first));
}
