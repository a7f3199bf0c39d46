#!/usr/bin/env bash
# The three rows of README's table, with what the paper publishes: benches/results/accuracy.md, in three minutes. Photographs are those of SHARED
# (../shared); the unseen set comes from the package luxpy, if pip can install it. TOOLS: the folder of the tools, else they are built.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
. benches/peers.sh
[ -n "${TOOLS:-}" ] || cargo build --quiet --release --bins
bin=${TOOLS:-${CARGO_TARGET_DIR:-target}/release}
shared=${SHARED:-../shared}
page=benches/results/accuracy.md
if [ ! -e "$shared/real" ]; then
    echo "benches/accuracy.sh: no photographs in $shared; left out" >&2
    exit
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unseen=$(unseen_sets "$work" tm30_kept) || {
    echo 'benches/accuracy.sh: pip cannot install luxpy; left out' >&2
    exit
}

{
    echo '# Accuracy in three rows'
    echo
    machine "$bin/vkernel"
    echo
    echo 'No camera took these pictures: they are simulated or rendered. Default options; CIEDE2000 for the 10° observer under D65; within: per cent of true'
    echo 'values within one and two standard deviations.'
    echo
    echo '- **Ideal, simulated**: the 24 patches of the ColorChecker, folded to 45°, D65, sigma-sd-merrill, facet noise of a thousandth of white, exposure known;'
    echo '  mean of 20 seeds. The paper: its method in the same setting without noise (its table 1).'
    echo '- **Rendered, all effects**: every picture of `real/all_*`, `real/more`, `real/pairs`, `sky` and `ground`, from a path tracer: gloss, rough bodies, rounded'
    echo '  creases, bowed panels, sky, ground and lens. Light, camera, angle and corners are stated with the errors of a careful user. No number was fitted to'
    echo '  these pictures, but results on them were in view while vfold was made. The paper: other sheets, photographed, with a chart (its table 2).'
    echo '- **Rendered, unseen sheets**: forty of `tm30_kept`, which was never in view when anything was chosen; vforward renders them with gloss, a rough body'
    echo '  and a blue sky (`benches/sheets.py`).'
    echo
    echo '| test | samples | RMSE | CIEDE2000 | within | the paper |'
    echo '|---|---|---|---|---|---|'
    python3 -B benches/accuracy.py "$bin" "$shared" $unseen
} | tee "$page.new"
mv "$page.new" "$page"
