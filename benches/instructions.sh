#!/bin/sh
# Instructions that each tool takes on the standard scene, on one thread under valgrind, beside those kept in benches/instructions.csv.
# Unlike times they hardly depend on the machine and what else it does, so that a change of one per cent shows.
#
#   benches/instructions.sh           print them and how they changed, and fail where they rose by more than MOST per cent (5):
#                                     half a minute once built
#   benches/instructions.sh --keep    count twice, and keep them if both counts agree within 0.5 %
#
# Tools in the folder TOOLS are counted as they are.
#
# They are those of benches/counted.toml, which are nearly those of a release: that would take longer than all the rest.
# A change that is worth more is kept with its reason in the commit.
set -eu
cd "$(dirname "$0")/.."
kept=$PWD/benches/instructions.csv
if [ -z "${TOOLS:-}" ]; then
    cargo build --quiet --config benches/counted.toml --bins
    TOOLS=${CARGO_TARGET_DIR:-target}/debug
fi
bin=$(cd "$TOOLS" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp tests/data/photos/a_ideal_magenta_50.exr "$work/photo.exr"
cd "$work"

# Each byte that `rep stosb` or `rep movsb` sets or copies would count as an instruction, from sizes on that depend on the processor.
without_rep=glibc.cpu.x86_rep_stosb_threshold=0x7fffffff:glibc.cpu.x86_rep_movsb_threshold=0x7fffffff

# count WHAT TOOL FLAGS...: a row of the table; the tool reads the file `in` and writes `out`.
count() {
    what=$1 tool=$2
    shift 2
    if ! env -i GLIBC_TUNABLES="$without_rep" valgrind --tool=callgrind --callgrind-out-file=calls "$bin/$tool" -j 1 "$@" <in >out 2>log; then
        cat log >&2
        echo "benches/instructions.sh: $tool cannot be counted" >&2
        return 1
    fi
    echo "$what,$(sed -n 's/.*Collected : //p' log)"
}

counts() {
    : >in
    count 'vkernel --angle-deg 45' vkernel --angle-deg 45
    mv out in
    count 'vforward --reflectance cc24' vforward --reflectance cc24
    mv out in
    count 'vestimate: 24 sheets' vestimate
    mv out in
    count 'vscore --table' vscore --table
    "$bin/vkernel" --angle-deg 45 | "$bin/vforward" --reflectance cc24 --noise-sd 1e-3 >in
    count 'vestimate: 24 sheets with facet noise of 1e-3' vestimate
    "$bin/vkernel" --angle-deg 50 >in
    count 'vextract: a picture of 640 x 480 pixels' vextract photo.exr --camera canon-5d-mark-ii \
        --panel0 '332.1,462.5 345.3,77.1 121.9,11.9 103.9,442.2' --panel1 '332.1,462.5 345.3,77.1 484.9,16.7 472.0,453.4'
    mv out photograph
    count 'vextract --find: the same picture' vextract --find photo.exr
    mv photograph in
    count 'vestimate: the photograph' vestimate
}

# beside OLD: the counts on standard input beside those of a file, and by how much they differ.
beside() {
    awk -F, -v old="$1" '
        BEGIN { while ((getline <old) > 0) before[$1] = $2; print "| instructions, millions | kept | now | change |\n|---|---|---|---|" }
        { was = before[$1]; printf "| %s | %s | %.1f | %s |\n", $1, was ? sprintf("%.1f", was / 1e6) : "", $2 / 1e6,
              was ? sprintf("%+.2f %%", 100 * ($2 / was - 1)) : "new" }'
}

# risen OLD: a line for each count on standard input that is beyond that of a file, and whether there is any.
risen() {
    awk -F, -v old="$1" -v most="${MOST:-5}" '
        BEGIN { while ((getline <old) > 0) before[$1] = $2 }
        before[$1] && $2 > (1 + most / 100) * before[$1] {
            print "benches/instructions.sh: " $1 " takes more than " most " % more instructions; save them, or keep them with --keep, and say why"
            any = 1
        }
        END { exit !any }'
}

case ${1:-} in
    --keep)
        counts >once
        counts >again
        beside once <again
        awk -F, 'NR == FNR { once[$1] = $2; next } ($2 / once[$1] - 1) ^ 2 > 25e-6 { print "not the same twice: " $1; apart = 1 }
            END { exit apart }' once again
        { echo "# benches/counted.toml, $(rustc --version), $(valgrind --version)"; cat again; } >"$kept"
        ;;
    *)
        counts >now
        beside "$kept" <now
        if risen "$kept" <now >&2; then exit 1; fi
        ;;
esac
