//! Files that a run cannot go on with; they stay as they are.

use crate::{assert_refused, case};

#[test]
fn files_to_resume() {
    assert_refused(
        r#"
        vkernel --facets 2x2 | vforward --reflectance cc24 -o samples.ndjson
        head -n 9 samples.ndjson > fewer.ndjson
        vestimate < samples.ndjson > estimates.ndjson
        vestimate --no-history < samples.ndjson > nameless.ndjson
        sed '3s/"sample"/"scrap"/' estimates.ndjson > scrap.ndjson
        sed 's/cc24:blue-sky/cc24:sky/' estimates.ndjson > renamed.ndjson
        sed '5s/$/ /' estimates.ndjson > spaced.ndjson
        { head -n 3 estimates.ndjson; tail -n +5 estimates.ndjson; } > gap.ndjson
        { head -n 3 estimates.ndjson; head -c 99 /dev/zero; echo; } > zeros.ndjson
        { head -n 3 estimates.ndjson; head -c 99 /dev/zero; } > zeros-at-the-end.ndjson
        printf '\377\330\n\377\340' > photo.jpg
        printf 'notes' > notes.txt
        cat > refused <<'END'
        kept=$(cksum < "$1")
        status=0
        vestimate --resume "$@" || status=$?
        [ "$kept" = "$(cksum < "$1")" ]
        exit $status
END
        mkdir folder
        mkfifo pipe
        "#,
        &[
            case("vestimate samples.ndjson --resume folder", 1, &["folder", "directory"]),
            case("vestimate samples.ndjson --resume pipe", 1, &["pipe", "regular file"]),
            case("vestimate samples.ndjson --resume no/such", 1, &["no/such"]),
            case("vestimate samples.ndjson --resume -", 2, &["--resume", "name a file"]),
            case("vestimate samples.ndjson --resume a -o b", 2, &["--resume", "--output"]),
            case("vestimate samples.ndjson --resume a --trace b", 2, &["--resume", "--trace"]),
            case("sh refused samples.ndjson < samples.ndjson", 1, &["samples.ndjson:1", "'history'"]),
            case("sh refused nameless.ndjson < samples.ndjson", 1, &["nameless.ndjson:1", "'history'"]),
            case(
                "sh refused nameless.ndjson --no-history --prior smooth < samples.ndjson",
                1,
                &["nameless.ndjson:2", "the 'estimate' of sample"],
            ),
            case("sh refused estimates.ndjson --prior smooth < samples.ndjson", 1, &[":1", "'history'"]),
            case("sh refused estimates.ndjson < fewer.ndjson", 1, &["estimates.ndjson:10", "more records"]),
            case(
                "vkernel --facets 3x3 | vforward --reflectance cc24 | sh refused estimates.ndjson",
                1,
                &[":1", "scene 'fold'"],
            ),
            case(
                "sh refused scrap.ndjson < samples.ndjson",
                1,
                &["scrap.ndjson:3", "scrap 'cc24:light-skin'"],
            ),
            case("sh refused renamed.ndjson < samples.ndjson", 1, &[":4", "'cc24:sky'", "'cc24:blue-sky'"]),
            case("sh refused spaced.ndjson < samples.ndjson", 1, &["spaced.ndjson:5", "written differently"]),
            case("sh refused gap.ndjson < samples.ndjson", 1, &["gap.ndjson:4", "'cc24:blue-sky'"]),
            case(
                "sh refused zeros.ndjson < samples.ndjson",
                1,
                &["zeros.ndjson:4", "not the line that this run writes"],
            ),
            case("sh refused zeros-at-the-end.ndjson < samples.ndjson", 1, &[":4", "not part of a record"]),
            case("sh refused photo.jpg < samples.ndjson", 1, &["photo.jpg:2", "not part of a record"]),
            case("sh refused notes.txt < samples.ndjson", 1, &["notes.txt:1", "not part of a record"]),
            case(
                "exec 9>> estimates.ndjson; flock 9; vestimate samples.ndjson --resume estimates.ndjson",
                1,
                &["estimates.ndjson", "another run"],
            ),
        ],
    );
}
