#!/usr/bin/env bash
# Photographs of real sheets: those of SHARED (../shared), then forty of every set (CSV file) given as an argument, which vforward takes:
# how near, how often bars hold and how long it takes: benches/results/sheets.md, in three minutes. Two more sets come from the package luxpy,
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
    echo 'Rendered photographs and folds of measured materials, which others made (`real`, `sky`, `ground`, `materials`); then forty sheets drawn of each set, which vforward'
    echo 'photographs: gloss and a rough body, a blue sky, a sun of 5100 to 5500 K, and a camera of which another measurement is told; the angle is told within'
    echo '1.2°, the tilt not at all, the light as D50, D55 or D65, corners within half a pixel, the exposure of half of them within 5 %. Default options.'
    echo 'Far: estimates further off than 0.1. Within: per cent of true values within one and two standard deviations. Median: ms, one thread, the whole'
    echo 'of vestimate. That a loose fit is not believed was found in draws of paints and natural surfaces; nothing was chosen with tm30_kept in view.'
    [ -z "$left_out" ] || echo "$left_out"
    echo
    echo '| photographs | count | RMSE | far | within | median |'
    echo '|---|---|---|---|---|---|'
    python3 -B benches/sheets.py "$bin" "$shared" "$@" $unseen
} | tee "$page.new"
mv "$page.new" "$page"
