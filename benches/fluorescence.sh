#!/usr/bin/env bash
# How far off sheets that fluoresce are, and how often others are reported to: benches/results/fluorescence.md, in a minute. Sheets and photographs are
# those of SHARED (../shared).
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
shared=${SHARED:-../shared}
page=benches/results/fluorescence.md
if [ ! -e "$shared/fluorescence" ]; then
    echo "benches/fluorescence.sh: no sheets in $shared; left out" >&2
    exit
fi
made_by=$(machine "$bin/vkernel")

{
    echo '# Sheets that fluoresce'
    echo
    echo "$made_by"
    echo
    echo 'Sheets of `../shared/fluorescence` and `../shared/thin`, computed by another model. RMSE and per cent of true values within two standard deviations,'
    echo '400 to 700 nm, of the reflectance and of the total radiance factor; an estimate without such a factor counts with its reflectance. Fluorescent, thin:'
    echo 'in how many estimates this is reported. The last column counts good estimates with less than 70 % of true values within two standard deviations.'
    echo
    python3 -B benches/fluorescence.py "$bin" "$shared"
} | tee "$page.new"
mv "$page.new" "$page"
