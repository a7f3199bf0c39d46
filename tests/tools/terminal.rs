//! Manners on a terminal, which Python's pty plays: progress, plots and colours, and none of them where there
//! is no terminal.

use crate::common::{Ended, Workdir};

/// Runs its argument on a terminal of 80 columns and prints what is then on it.
const PTY: &str = r#"
import fcntl, os, pty, struct, sys, termios
def read(terminal):
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    return os.read(terminal, 65536)
status = pty.spawn(["sh", "-euc", sys.argv[1]], read)
sys.exit(os.waitstatus_to_exitcode(status))
"#;

const SETUP: &str = r"
export LC_ALL=C.UTF-8 TERM=xterm PYTHONCOERCECLOCALE=0
unset NO_COLOR CLICOLOR CLICOLOR_FORCE CI
vkernel --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:red --noise-sd 1e-3 -o samples.ndjson
vestimate samples.ndjson -o estimates.ndjson
";

/// What `command` leaves on a terminal, and in files.
fn on_terminal(setup: &str, command: &str) -> Ended {
    let script = format!(
        "{SETUP}{setup}\ncat > terminal.py <<'END'{PTY}END\npython3 terminal.py '{}' < /dev/null",
        command.replace('\'', r"'\''")
    );
    let run = Workdir::new().sh(&script);
    assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{command}: {run:?}");
    run
}

/// Without what colours and moves.
fn plain(text: &str) -> String {
    let parts = text.split("\x1b[").enumerate();
    let after = |(n, part): (usize, &str)| match part.find(|c: char| c.is_ascii_alphabetic()) {
        Some(end) if n > 0 => part[end + 1..].to_owned(),
        _ => part.to_owned(),
    };
    parts.map(after).collect()
}

#[test]
fn a_batch_says_how_far_it_is() {
    let pictures = concat!(
        "cp '",
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/photos/a_ideal_magenta_50.exr' 1.exr; for n in $(seq 2 60); \
         do ln -s 1.exr $n.exr; done\n",
        "vkernel --angle-deg 50 -o scene.json"
    );
    let extract = "vextract *.exr --scene scene.json --camera canon-5d-mark-ii --illuminant D65 -j 1 \
        -o out.ndjson --panel0 \"332,462 345,77 122,12 104,442\" --panel1 \"332,462 345,77 485,17 472,446\"";
    let shown = plain(&on_terminal(pictures, extract).stdout);
    let drawn = shown.split("vextract: ").find(|line| line.contains(" of 60 samples, "));
    let drawn = drawn.unwrap_or_default();
    assert!(drawn.contains("/s, ") && drawn.contains("s left"), "{shown:?}");
    assert!(shown.trim_end().rsplit("vextract: ").next().unwrap().starts_with("60 samples in "), "{shown:?}");
}

#[test]
fn a_long_solution_says_that_it_is_at_work() {
    let slow = concat!(
        "mkfifo slow.obj; { sleep 2; cat '",
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/shapes/corner.obj'; } > slow.obj &"
    );
    let shown = plain(&on_terminal(slow, "vkernel --shape slow.obj --mesh facets -o out.json").stdout);
    assert!(shown.contains("vkernel: running for 1s"), "{shown:?}");
}

/// Lines about samples stand above that of the progress, not in it.
#[test]
fn what_is_said_keeps_its_line() {
    let slow = "mkfifo slow; { head -n 2 samples.ndjson; sleep 2; tail -n 1 samples.ndjson; } > slow &";
    let shown = plain(&on_terminal(slow, "vestimate slow -v -o out.ndjson").stdout);
    assert!(shown.contains("vestimate: 1 sample, "), "{shown:?}");
    let said: Vec<_> = shown.split('\n').filter(|line| line.contains("residual")).collect();
    assert_eq!(said.len(), 2, "{shown:?}");
    for line in said {
        let last = line.rsplit('\r').find(|drawn| !drawn.is_empty()).unwrap();
        assert!(last.starts_with("vestimate: cc24:red: prior sheets, "), "{shown:?}");
    }
}

#[test]
fn nothing_moves_where_records_pass() {
    for command in ["vestimate samples.ndjson", "vestimate samples.ndjson | cat", "vkernel 2>said; cat said"]
    {
        let shown = on_terminal("", command).stdout;
        assert!(!shown.contains('\x1b'), "{command}: {shown:?}");
    }
    let quiet = on_terminal("", "vestimate samples.ndjson --progress always -q -o out.ndjson").stdout;
    assert_eq!(quiet, "");
}

const PLOT: &str = "vestimate samples.ndjson --plot - -o out.ndjson";

#[test]
fn a_plot_is_as_wide_as_the_terminal_and_coloured() {
    let shown = on_terminal("", PLOT).stdout;
    assert!(shown.contains("\x1b[34m") && shown.contains('⠒'), "{shown}");
    // what is said of the estimate is a line of text below
    let drawn = plain(&shown);
    let widest =
        drawn.lines().filter(|line| !line.starts_with("vestimate: ")).map(|line| line.chars().count()).max();
    assert!(widest.is_some_and(|widest| (77..=80).contains(&widest)), "{widest:?} {shown}");
}

#[test]
fn a_plot_is_plain_where_colours_or_characters_are_not_wanted() {
    for setup in ["export NO_COLOR=1", "export TERM=dumb"] {
        let shown = on_terminal(setup, PLOT).stdout;
        assert!(!shown.contains('\x1b') && shown.contains('░'), "{setup}: {shown:?}");
    }
    for setup in
        ["export LC_ALL=C", "unset LC_ALL; export LC_CTYPE=POSIX LANG=C.UTF-8", "unset LC_ALL LC_CTYPE LANG"]
    {
        let shown = on_terminal(setup, PLOT).stdout;
        assert!(shown.is_ascii() && shown.contains('*'), "{setup}: {shown:?}");
    }
}

#[test]
fn a_plot_leaves_the_records_alone() {
    let script = format!(
        "{SETUP}vestimate samples.ndjson --plot - 2> plot | tail -n 1 | cut -c 1-16; grep -c '─' plot; \
         vscore estimates.ndjson --table --plot - 2> /dev/null | cut -c 1-6; \
         vestimate samples.ndjson -q --plot - 2>&- | wc -l"
    );
    let run = Workdir::new().sh(&script);
    assert_eq!(run.stdout, "{\"kind\":\"sample\"\n1\nsample\ncc24:r\nmean  \nmedian\nworst \n2\n", "{run:?}");
}

#[test]
fn help_is_coloured_on_a_terminal_alone() {
    assert!(on_terminal("", "vkernel --help").stdout.contains("\x1b["));
    for setup in ["export NO_COLOR=1", "export TERM=dumb"] {
        assert!(!on_terminal(setup, "vkernel --help").stdout.contains('\x1b'), "{setup}");
    }
    assert!(!Workdir::new().sh("vkernel --help").stdout.contains('\x1b'));
}

/// A line a sample where somebody reads it, at the end, and none elsewhere.
#[test]
fn verdicts_stand_at_the_end() {
    let shown = plain(&on_terminal("", "vestimate samples.ndjson -o out.ndjson").stdout);
    assert!(shown.contains("vestimate: cc24:red: good: model and facets "), "{shown:?}");
    assert!(shown.contains("the light D65 or the camera canon-5d-mark-ii"), "{shown:?}");
    let many =
        "vforward scene.json --reflectance munsell --noise-sd 1e-3 2>/dev/null | head -n 40 > many.ndjson";
    let shown = plain(&on_terminal(many, "vestimate many.ndjson -o out.ndjson").stdout);
    let counted = shown.lines().filter(|line| line.contains(" good, ") && line.contains(" wrong")).count();
    assert!(counted == 1 && !shown.contains(": good: "), "{shown:?}");
    assert_eq!(on_terminal("", "vestimate samples.ndjson -q -o out.ndjson").stdout, "");
    assert_eq!(on_terminal("", "vestimate samples.ndjson -o out.ndjson 2> said; cat said").stdout, "");
}

/// Names from a stream, from files of spectra and their names: what acts on a terminal is shown, not done.
#[test]
fn names_do_nothing_to_a_terminal() {
    let folder = Workdir::new();
    let run = folder.sh(r#"
vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:blue --noise-sd 1e-3 > plain
jq -c 'if .id == "cc24:red"
    then .id = "r\u001b]0;title\u0007\u001b[2J\u009b31m\u007f\u202eder\u2066\u200f\u2028\nx" else . end' \
    plain > escapes.ndjson
vestimate escapes.ndjson -v --plot - > estimates.ndjson 2> said
vscore estimates.ndjson --plot - --table > table 2>> said
jq -c 'if .kind == "scene" then .geometry.name = "\u001b[2J\u202e" else . end' estimates.ndjson |
    vscore --by geometry.name --table >> table 2>> said
mkdir own; printf 'nm,a\n400,0.5\n700,0.5\n' > "own/$(printf 'w\033[2J\342\200\256e').csv"
VFOLD_DATA=own vkernel --list reflectances > list
VFOLD_DATA=own vforward escapes.ndjson --reflectance "$(printf 'w\033[2J\342\200\256')" 2>> said || :
vestimate "$(printf 'no\033[2J\342\200\256.ndjson')" 2>> said || :
vkernel "$(printf -- '--no\033[2J\342\200\256')" 2>> said || :
cat said table list"#);
    assert_eq!(run.status, 0, "{run:?}");
    let acts = |letter: char| {
        (letter.is_control() && letter != '\n')
            || "\u{61c}\u{200e}\u{200f}\u{2028}\u{2029}".contains(letter)
            || ('\u{202a}'..='\u{202e}').contains(&letter)
            || ('\u{2066}'..='\u{2069}').contains(&letter)
    };
    let acting: Vec<_> = run.stdout.lines().filter(|line| line.contains(acts)).collect();
    assert!(acting.is_empty(), "{acting:?}");
    for (file, shown) in [("said", 5), ("table", 3), ("list", 1)] {
        let count = folder.sh(&format!("grep -c 'u{{1b}}.*2J' {file}")).stdout;
        assert_eq!(count.trim().parse::<usize>().unwrap(), shown, "{file}: {}", run.stdout);
    }
}
