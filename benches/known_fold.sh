#!/usr/bin/env bash
# What a fold of a known sheet adds: benches/results/known_fold.md, in a minute.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
page=benches/results/known_fold.md
made_by=$(machine "$bin/vkernel")

{
    echo '# What a known fold adds'
    echo
    echo "$made_by"
    echo
    echo "The ColorChecker's 24 patches, noise 1e-3 of white, exposure free, three seeds, with the light stated and unknown, without and with a known fold: grey,"
    echo 'of reflectance 0.5. RMSE: mean, median, worst; per cent of true values within two standard deviations.'
    echo
    python3 -B benches/known_fold.py "$bin"
} | tee "$page.new"
mv "$page.new" "$page"
