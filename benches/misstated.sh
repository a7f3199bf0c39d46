#!/usr/bin/env bash
# README's photograph with something stated wrongly, and what vestimate makes of it: benches/results/misstated.md, in some seconds. TOOLS: the folder of the
# tools, else they are built.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
[ -n "${TOOLS:-}" ] || cargo build --quiet --release --bins
bin=${TOOLS:-${CARGO_TARGET_DIR:-target}/release}
page=benches/results/misstated.md
{
    echo '# Stated wrongly'
    echo
    machine "$bin/vkernel"
    echo
    echo "README's photograph, \`tests/data/photos/a_ideal_magenta_50.exr\`, an ideal fold of 50° without noise, with one thing stated wrongly. Within: per cent of"
    echo 'true values within two standard deviations. Because: the reason in the verdict.'
    echo
    echo '| stated | RMSE | CIEDE2000 | within | verdict | because |'
    echo '|---|---|---|---|---|---|'
    python3 -B benches/misstated.py "$bin" tests/data/photos
} | tee "$page.new"
mv "$page.new" "$page"
