#!/usr/bin/env bash
# Estimates of every set (CSV file) named as an argument and of the ColorChecker, through five cameras in five lights, exposure known and free, and
# of 5000 spectra that no chart has: errors, how often error bars hold, local modes and times: benches/results/sets.md. Thirteen minutes. Cameras
# that are not built in are taken from CAMERAS (../shared/data/cameras), four more sets from the package luxpy, if pip can install it.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
. benches/peers.sh
cargo build --quiet --release --bins --benches
bin=${CARGO_TARGET_DIR:-target}/release
cameras=${CAMERAS:-../shared/data/cameras}
page=benches/results/sets.md
made_by=$(machine "$bin/vkernel")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unseen=$(unseen_sets "$work") && left_out= || left_out="luxpy cannot be had here; its sets are left out"

# row NAME NOISE FLAGS STREAM...: their estimates
row() {
    printf '| %s | %s | ' "$1" "$2"
    shift 2
    cargo bench --quiet --bench sets -- "$@" | sed 's/$/ |/'
}

# streams TABLE NOISE: the facets of a set through every camera
streams() {
    while read -r camera light; do
        "$bin/vkernel" | "$bin/vforward" --reflectance "$1" --noise-sd "$2" --camera "$camera" --illuminant "$light" >"$work/$light.ndjson"
        echo "$work/$light.ndjson"
    done <<END
canon-5d-mark-ii D65
$cameras/nikon_d700.csv A
$cameras/sony_ilce_7m4.csv D50
$cameras/fujifilm_x_t3.csv FL11
$cameras/canon_eos_r5.csv LED-V1
END
}

# below_one TABLE: without what is above 1: it fluoresces, or was scaled wrongly
below_one() {
    awk -F, 'NR == FNR { if (FNR > 1) for (n = 2; n <= NF; n++) if ($n > 1) off[n] = 1; next }
        { line = $1; for (n = 2; n <= NF; n++) if (!(n in off)) line = line "," $n; print line }' "$1" "$1"
}

{
    echo '# Sets'
    echo
    echo "$made_by"
    echo
    echo '45°, 10 x 10 facets per panel. Sets through Canon EOS 5D Mark II, D65; Nikon D700, A; Sony A7 IV, D50; Fujifilm X-T3, FL11; Canon EOS R5, LED-V1;'
    echo '"many" are greys, whites, dyes and edges through the first. Exposure known and free. Within: per cent of true values within one and two'
    echo 'standard deviations, of all wavebands; violet, red: at 400 to 420 and at 680 to 700 nm. Local modes: estimates that end in a worse one, further from the'
    echo 'truth than a search that starts there, by an RMSE of 0.01 and a factor of two. Time of an estimate: ms, one thread, the fastest of three runs.'
    echo 'Nothing was chosen with tm30_kept (`benches/unseen.py`) in view, and no class of spectra with cri2012, opstelten or tm30.'
    [ -z "$left_out" ] || echo "$left_out"
    echo
    echo '| set | facet noise | estimates | RMSE | within | violet | red | local modes | mean, ms | median | 95 % | worst |'
    echo '|---|---|---|---|---|---|---|---|---|---|---|---|'
    for noise in 0 1e-3 1e-2; do
        [ $noise = 0 ] && maxima=--maxima || maxima=
        for set in share/cc24.csv "$@" $unseen; do
            below_one "$set" >"$work/set.csv"
            row "$(basename "$set" .csv)" $noise $maxima $(streams "$work/set.csv" $noise)
        done
    done
    cargo bench --quiet --bench sets -- --spectra 5000 >"$work/many.csv"
    for noise in 0 1e-3; do
        "$bin/vkernel" | "$bin/vforward" --reflectance "$work/many.csv" --noise-sd $noise >"$work/many.ndjson"
        row many $noise "$work/many.ndjson"
    done
} | tee "$page.new"
mv "$page.new" "$page"
