//! `--resume`: a run that was killed goes on, and its file is in the end that of one run.

use crate::common::Workdir;

/// 24 samples, of which the third is unusable, and what one run makes of them.
const ESTIMATES: &str = "
    vkernel --facets 2x2 | vforward --reflectance cc24 --noise-sd 1e-3 \
        | sed '4s/facet_rgb/facets/' > samples.ndjson
    vestimate samples.ndjson > whole.ndjson || [ $? = 3 ]
    resume() { vestimate samples.ndjson --resume out.ndjson \"$@\"; }";

/// A status of 3 for the record with an error, and the bytes of one run.
const GOES_ON: &str = "
    status=0; resume || status=$?
    [ $status = 3 ]
    cmp out.ndjson whole.ndjson";

#[test]
fn wherever_it_was_cut() {
    let folder = Workdir::new();
    folder.sh(ESTIMATES);
    let cut = format!(
        "{ESTIMATES}
        scene=$(head -n 1 whole.ndjson | wc -c) size=$(wc -c < whole.ndjson)
        for bytes in 0 1 8 9 $((scene - 1)) $scene $((scene + 1)) $((scene + 5000)) \
            $((size / 2)) $((size - 1)) $size; do
            head -c $bytes whole.ndjson > out.ndjson
            {GOES_ON}
        done"
    );
    let run = folder.sh(&cut);
    assert_eq!((run.status, run.stdout.as_str(), run.said_otherwise()), (0, "", Vec::new()));
}

/// Killed again and again, with one thread and with two.
#[test]
fn however_often_it_was_killed() {
    let run = Workdir::new().sh(&format!(
        "{ESTIMATES}
        mkfifo slowly
        : > out.ndjson
        for threads in 1 2 1 2; do
            want=$((3 * threads + $(wc -l < out.ndjson)))
            {{ head -n $want samples.ndjson; exec sleep 60; }} > slowly & feeder=$!
            vestimate - -j $threads --resume out.ndjson < slowly & tool=$!
            for try in $(seq 200); do
                [ $(wc -l < out.ndjson) = $want ] && break || sleep 0.1
            done
            kill -9 $tool $feeder
            # the file is free once the tool has ended
            wait $tool 2>/dev/null || :
            wc -l < out.ndjson
        done
        vestimate - --resume out.ndjson < samples.ndjson || [ $? = 3 ]
        tail -n +2 whole.ndjson > whole; tail -n +2 out.ndjson | cmp - whole"
    ));
    let lines: Vec<usize> = run.stdout.lines().map(|line| line.parse().unwrap()).collect();
    assert!(run.status == 0 && run.said_otherwise().is_empty(), "{run:?}");
    // every record that could be made was there when the run was killed
    assert_eq!(lines, [3, 9, 12, 18]);
}

/// Records that are kept count as if they had been made: arrays, pictures, summaries.
#[test]
fn arrays_plots_and_summaries_are_whole() {
    let run = Workdir::new().sh(&format!(
        "{ESTIMATES}
        vscore whole.ndjson > scores.ndjson || [ $? = 3 ]
        as_arrays() {{ resume --plot out.svg --save reflectance=out.npy || [ $? = 3 ]; }}
        as_arrays
        mv out.npy whole.npy
        mv out.svg whole.svg
        head -n 9 out.ndjson > half.ndjson
        mv half.ndjson out.ndjson
        as_arrays
        cmp out.npy whole.npy
        cmp out.svg whole.svg
        head -n 9 scores.ndjson > half.ndjson
        vscore whole.ndjson --resume half.ndjson || [ $? = 3 ]
        cmp half.ndjson scores.ndjson
        vscore whole.ndjson --resume half.ndjson || [ $? = 3 ]
        cmp half.ndjson scores.ndjson"
    ));
    assert_eq!((run.status, run.stdout.as_str(), run.said_otherwise()), (0, "", Vec::new()));
}

/// What is there is not made again but for the first estimate: another that no run would make stays.
#[test]
fn estimates_are_not_made_again() {
    let run = Workdir::new().sh(&format!(
        "{ESTIMATES}
        sed '3s/\"iterations\":[0-9]*/\"iterations\":4711/' whole.ndjson | head -n 3 > out.ndjson
        resume || [ $? = 3 ]
        grep -c '\"iterations\":4711' out.ndjson"
    ));
    assert_eq!((run.status, run.stdout.as_str()), (0, "1\n"), "{run:?}");
}

/// A file that the same command reads may have another content.
#[test]
fn a_file_of_other_content_is_another_command() {
    let run = Workdir::new().sh("vkernel --facets 4x4 -o scene.json
        light() { vforward -q scene.json --noise-sd 1e-3 --illuminant \"$@\"; }
        light FL2 --reflectance cc24:red cc24:green > sheets.ndjson
        resume() {
            vestimate -q sheets.ndjson --illuminant unknown --known-fold card.ndjson=0.5 --resume out.ndjson
        }
        light FL2 --reflectance 0.5 > card.ndjson
        resume && head -n 2 out.ndjson > begun && cp begun out.ndjson && resume && wc -l < out.ndjson
        light A --reflectance 0.5 > card.ndjson
        cp begun out.ndjson && resume");
    assert_eq!((run.status, run.stdout.as_str()), (1, "3\n"), "{run:?}");
    assert!(run.stderr.contains("is not what this run makes"), "{run:?}");
}

#[test]
fn photographs_are_measured_once() {
    let photo = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/photos/a_ideal_magenta_50.exr");
    let run = Workdir::new().sh(&format!(
        r#"vkernel --angle-deg 50 --facets 2x2 -o scene.json
        for n in 1 2 4; do ln -s '{photo}' $n.exr; done
        echo 'no picture' > 3.exr
        extract() {{
            vextract 1.exr 2.exr 3.exr 4.exr --scene scene.json --camera canon-5d-mark-ii \
                --illuminant D65 "$@" --panel0 "332,462 345,77 122,12 104,442" \
                --panel1 "332,462 345,77 485,17 472,446" || [ $? = 3 ]
        }}
        extract > whole.ndjson
        {{ head -n 3 whole.ndjson; echo -n '{{"kind":"sample","id":"\303'; }} > out.ndjson
        extract -v --resume out.ndjson 2> said
        cmp out.ndjson whole.ndjson
        grep -v " failed; first: \|corners moved" said | cut -d: -f2"#
    ));
    assert_eq!((run.status, run.stdout.as_str()), (0, " 4.exr\n"), "{run:?}");
}
