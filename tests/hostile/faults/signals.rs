//! SIGINT, SIGTERM, SIGKILL while a file is written.

use crate::common::Workdir;
use crate::ready::{ready, sh};

/// Each tool in the middle of its work, more to come from the pipe `slow`, its standard input or a
/// photograph, or from a computation that takes long, and how many files are then open. Photographs on one
/// thread: of several, one that waits for the rest of a photograph may take up the next, and hold the first
/// back until that has come.
const HALFWAY: [(&str, &str, usize); 5] = [
    ("vkernel --method monte-carlo --samples 100000000 -o old", "true", 1),
    ("vforward - --reflectance cc24 -o old --save facet_rgb=old.npy", "cat scene.json", 2),
    ("sh extract -j 1 photo.exr slow -o old --save facet_rgb=old.npy", "true", 2),
    ("vestimate - -o old --save reflectance=old.npy", "head -n 9 samples.ndjson", 2),
    ("vscore - -o old --save rmse=old.npy", "head -n 9 estimates.ndjson", 2),
];

/// Starts a tool and a feeder that never ends, waits for `ready`, sends the signal; prints the tool's status.
fn interrupt(folder: &Workdir, [tool, feed, ready, signal]: [&str; 4]) -> String {
    let script = format!(
        "rm -f slow; mkfifo slow
        {{ {feed}; exec sleep 60; }} > slow & feeder=$!
        env --default-signal=INT {tool} < slow > /dev/null 2>&1 & tool=$!
        for try in $(seq 300); do
            {ready} && break || sleep 0.1
        done
        {ready} || echo 'never got there'
        kill -{signal} $tool
        status=0; wait $tool || status=$?
        kill $feeder; rm slow
        echo $status"
    );
    sh(folder, &script).stdout
}

#[test]
fn whatever_ends_it_the_old_file_stays_and_nothing_beside_it() {
    let folder = ready();
    let before = sh(&folder, "echo before > old; echo before > old.npy; ls -A; cat old*").stdout;
    for (tool, feed, files) in HALFWAY {
        let ready =
            format!("[ $(ls -l /proc/$tool/fd | grep \"$PWD/\" | grep -vc -e '/slow$' -e photo) = {files} ]");
        for (signal, status) in [("INT", "130\n"), ("TERM", "143\n"), ("KILL", "137\n")] {
            assert_eq!(interrupt(&folder, [tool, feed, &ready, signal]), status, "{tool} {signal}");
            assert_eq!(sh(&folder, "ls -A; cat old*").stdout, before, "{tool} {signal}");
        }
    }
}

/// A line in the file is a promise: it is there after a SIGKILL, and is not made again.
#[test]
fn no_record_that_was_written_is_lost() {
    let folder = ready();
    let runs = [
        ("vforward - --reflectance cc24", "cat scene.json", "cat scene.json |", 25),
        ("sh extract -j 1 photo.exr photo.exr slow", "true", "cp -p photo.exr slow;", 3),
        ("vestimate -", "head -n 9 samples.ndjson", "cat samples.ndjson |", 9),
        ("vscore -", "head -n 9 estimates.ndjson", "cat estimates.ndjson |", 9),
    ];
    for (tool, feed, all, lines) in runs {
        let whole = format!("{all} {tool} > whole");
        assert_eq!(sh(&folder, &whole).status, 0, "{tool}");
        for signal in ["INT", "TERM", "KILL"] {
            let ready = format!("[ $(cat out | wc -l) -ge {lines} ]");
            sh(&folder, ": > out");
            let status = interrupt(&folder, [&format!("{tool} --resume out"), feed, &ready, signal]);
            assert!(["130\n", "143\n", "137\n"].contains(&status.as_str()), "{tool}: {status}");
            let go_on = whole.replace("> whole", "--resume out");
            let ended =
                sh(&folder, &format!("head -c $(wc -c < out) whole | cmp - out; {go_on}; cmp out whole"));
            assert_eq!((ended.status, ended.stdout.as_str()), (0, ""), "{tool} {signal}: {ended:?}");
        }
    }
}
