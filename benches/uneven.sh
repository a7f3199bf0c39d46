#!/usr/bin/env bash
# What lamps near by and shadows do where sunlight is stated: benches/results/uneven.md, in two minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
page=benches/results/uneven.md
made_by=$(machine "$bin/vkernel")

{
    echo '# Uneven light'
    echo
    echo "$made_by"
    echo
    echo 'Rendered photographs of every fourth patch of the ColorChecker, folded to 50°, with photon noise; exposure free, the light stated as D55 from the sun.'
    echo 'RMSE, per cent of true values within two standard deviations, verdicts, and how often lamp, fall-off or shadow is named.'
    echo
    python3 -B benches/uneven.py "$bin"
} | tee "$page.new"
mv "$page.new" "$page"
