#!/usr/bin/env bash
# What half and double of each number in the priors of photographs do to estimates, on the photographs and materials that they are fitted to:
# benches/results/photograph-priors.md, in ten minutes. `--fit [NAME...]` changes numbers, or these, as long as the score rises, and prints those changed.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
shared=${SHARED:-../shared}
page=benches/results/photograph-priors.md
if [ ! -e "$shared/train" ]; then
    echo "benches/photograph_priors.sh: no photographs in $shared/train; left out" >&2
    exit
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -B benches/photograph_priors.py "$bin" "$shared" "$work"
if [ "${1:-}" = --fit ]; then
    cargo bench --quiet --bench photograph_priors -- "$@" "$work"/*.ndjson
    exit
fi
{
    echo '# Priors of photographs'
    echo
    machine "$bin/vkernel"
    echo
    echo 'Every number of `src/estimate/photograph/priors.rs`, and what half and double of it do to what the numbers are fitted to: the 48 photographs of `train`,'
    echo 'and folds of six measured materials, each left out of the table of measured sheets, with exposure known and free. A mean is moved by half its standard'
    echo 'deviation, down and up. Score: mean logarithm of the posterior density at the truth, waveband by waveband, as a difference from the first row; more is'
    echo 'better. Error: mean RMSE. Photographs to which nothing is fitted are in [sheets](sheets.md).'
    echo
    cargo bench --quiet --bench photograph_priors -- "$work"/*.ndjson
} | tee "$page.new"
mv "$page.new" "$page"
