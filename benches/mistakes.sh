#!/usr/bin/env bash
# What becomes of mistakes: two hundred of them in simulated photographs, eight sheets each: benches/results/mistakes.md, in six minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
. benches/peers.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
page=benches/results/mistakes.md
if ! python=$(peer numpy numpy==2.2.6); then
    echo "benches/mistakes.sh: NumPy cannot be installed; left out" >&2
    exit
fi
made_by=$(machine "$bin/vkernel")
{
    echo '# What becomes of mistakes'
    echo
    echo "$made_by"
    echo
    echo 'Simulated photographs (180 x 135 px, noise of 20000 electrons) of eight matte sheets of the ColorChecker, folded to 45° in the sun, with one'
    echo 'thing wrong in each; controls have nothing wrong, or the usual errors of users. The verdict was designed with eight other sheets in view, except for'
    echo 'the number of other cameras that are searched. Right: good, and off by at most 0.03. Held: good, and 85 per cent of the true values within two standard'
    echo 'deviations. Lie: good, and neither. RMSE: mean of the good ones.'
    echo
    "$python" -B benches/mistakes.py "$bin"
} | tee "$page.new"
mv "$page.new" "$page"
