#!/usr/bin/env bash
# What becomes of mistakes: two hundred kinds of them in simulated photographs, eight sheets each: benches/results/mistakes.md, in six minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
page=benches/results/mistakes.md
if ! python3 -c 'import numpy' 2>/dev/null; then
    echo "benches/mistakes.sh: Python has no NumPy; left out" >&2
    exit
fi
made_by=$(machine "$bin/vkernel")
{
    echo '# What becomes of mistakes'
    echo
    echo "$made_by"
    echo
    echo 'Simulated photographs (180 x 135 px, noise of 20000 electrons) of eight matt sheets of the ColorChecker, folded to 45° in the sun, with one'
    echo 'thing wrong in each; controls have nothing wrong, or what people err by. Right: good, and off by at most 0.03. Held: good, and 85 per cent'
    echo 'of the true values within two standard deviations. Lie: good, and neither. RMSE: mean of those that are called good.'
    echo
    python3 -B benches/mistakes.py "$bin"
} | tee "$page.new"
mv "$page.new" "$page"
