//! The same command gives the same bytes, whatever the number of threads, and again and again.

use crate::common::Workdir;

const SETUP: &str = concat!(
    "photo='",
    env!("CARGO_MANIFEST_DIR"),
    "/tests/data/photos/a_ideal_magenta_50.exr'",
    r#"
for n in 1 2 3; do ln -s "$photo" $n.exr; done
vkernel --angle-deg 50 --facets 6x6 -o scene.json
vforward scene.json --reflectance cc24 --noise-sd 1e-3 -o samples.ndjson
vestimate samples.ndjson -o estimates.ndjson
vkernel --folds 2 --angle-deg 60 --ridge-deg 80 --facets 3x3 --light 0,1,2 -o shape.json
vkernel --angle-deg 180 --facets 1x1 |
    vforward --reflectance cc24 --illuminant A --illuminant D65 --illuminant FL11 -o flat.ndjson
"#
);

/// Every method and mode that sums in parallel or works on many samples; what it writes beside its records is
/// `file`.
const RUNS: [&str; 24] = [
    "vkernel --tolerance 1e-4",
    "vkernel --facets 24x24 --tolerance 1e-3 --save kernel=file",
    "vkernel --facets 40x9 --mesh facets --tolerance 1e-4 --spacing graded --tilt-deg 5 --sky 0.2",
    "vkernel --panel1-depth 3 --tolerance 1e-4",
    "vkernel --method monte-carlo --samples 3000 --save kernel=file",
    "vkernel --method monte-carlo --sampling cosine --samples 3000 --save kernel=file",
    "vkernel --check",
    "vkernel --folds 2 --angle-deg 60 --ridge-deg 80 --facets 3x3 --sky 0.2 --sky-type overcast \
        --light 0,1,2 --light point:1,1,3:0.5",
    "vforward scene.json --reflectance cc24 --noise-sd 1e-3 --photon-noise 1e-3 \
        --seed 4 --save facet_rgb=file",
    "vforward scene.json --reflectance cc24 --bounces 3 --panel-reflectance 0=cc24:red",
    "vforward scene.json --reflectance 0.5 --render file.exr --render-size 80x60",
    "vforward shape.json --reflectance cc24",
    "vextract 1.exr 2.exr 3.exr --scene scene.json --camera canon-5d-mark-ii --illuminant D65 \
        --refine --overlay file-{}.png --panel0 '332,462 345,77 122,12 104,442' \
        --panel1 '332,462 345,77 485,17 472,446'",
    "vestimate samples.ndjson --save covariance=file",
    "vestimate samples.ndjson --exposure free --plot file.svg",
    "head -n 4 samples.ndjson | vestimate --fit exposure,tilt,sky,angle --trace file",
    "vestimate samples.ndjson --prior smooth",
    "head -n 4 samples.ndjson | vestimate --prior smooth --smoothness auto",
    "vestimate scene.json --plan --camera nikon-d5100 --noise-sd 1e-3",
    "vestimate flat.ndjson --method park --spectra file.csv",
    "vestimate flat.ndjson --method khan --components 9",
    "vestimate samples.ndjson --resume file > /dev/null; cat file",
    "vscore estimates.ndjson --illuminant D65 --illuminant A --metrics gfc,angle,metamerism --colour",
    "vscore estimates.ndjson --plot file.png --table",
];

#[test]
fn threads_and_repetition_change_no_byte() {
    let folder = Workdir::new();
    let run = folder.sh(SETUP);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    let differing: Vec<String> = RUNS.iter().filter_map(|run| difference(&folder, run)).collect();
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}

/// What a run does otherwise when it is repeated on several threads.
fn difference(folder: &Workdir, run: &str) -> Option<String> {
    let (run, rest) = run.split_once(';').unwrap_or((run, ""));
    let once = |threads: usize| {
        format!(
            "rm -f file*; {{ {run} -q --no-history -j {threads}; {rest}
            }} > out; cat out $(ls file* 2> /dev/null || true)"
        )
    };
    let first = folder.sh(&format!("({}) > first; test -s first", once(1)));
    assert_eq!((first.status, first.stdout.as_str(), first.stderr.as_str()), (0, "", ""), "{run}");
    let again = folder.sh(&format!("({}) | cmp - first", once(8)));
    (again.status != 0).then(|| format!("{run} -j 8: {again:?}"))
}
