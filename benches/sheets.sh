#!/usr/bin/env bash
# Photographs of real sheets: those of SHARED (../shared), then forty of every set (CSV file) named as an argument, rendered by vforward:
# errors, how often error bars hold, and times: benches/results/sheets.md, in three minutes. Two more sets come from the package luxpy,
# if pip can install it.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
. benches/peers.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
shared=${SHARED:-../shared}
page=benches/results/sheets.md
if [ ! -e "$shared/real" ]; then
    echo "benches/sheets.sh: no photographs in $shared; left out" >&2
    exit
fi
made_by=$(machine "$bin/vkernel")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unseen=$(unseen_sets "$work" cri2012 tm30_kept) && left_out= || left_out="luxpy cannot be had here; its sets are left out"

{
    echo '# Photographs of real sheets'
    echo
    echo "$made_by"
    echo
    echo 'Rendered photographs and folds of measured materials, not made by vfold (`real`, `sky`, `ground`, `materials`); then forty sheets drawn from each set,'
    echo 'rendered by vforward: gloss and a rough body, a blue sky, a sun of 5100 to 5500 K, and a camera of which another measurement is stated; the angle is'
    echo 'stated within 1.2°, the tilt not, the light as D50, D55 or D65, corners within half a pixel, the exposure of half of them within 5 %. Default options.'
    echo 'Far: estimates off by more than 0.1. Within: per cent of true values within one and two standard deviations. Median: ms, one thread, the whole of'
    echo 'vestimate. That a loose fit is not trusted was decided with draws of paints and natural surfaces in view; nothing was chosen with tm30_kept in view.'
    [ -z "$left_out" ] || echo "$left_out"
    echo
    echo '| photographs | count | RMSE | far | within | median, ms |'
    echo '|---|---|---|---|---|---|'
    python3 -B benches/sheets.py "$bin" "$shared" "$@" $unseen
} | tee "$page.new"
mv "$page.new" "$page"
