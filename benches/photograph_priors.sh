#!/usr/bin/env bash
# What each number that is believed of photographs does to estimates, half and double of it, on the photographs and materials that they are fitted on:
# benches/results/photograph-priors.md, in ten minutes. `--fit [NAME...]` changes numbers, or these, as long as that brings more, and prints what it found.
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
    echo '# What is believed of photographs'
    echo
    machine "$bin/vkernel"
    echo
    echo 'Every number of `src/estimate/photograph/priors.rs`, and what half and double of it do on what numbers are fitted on: the 48 photographs of `train`, and'
    echo 'folds of six measured materials, each left out of the table of measured sheets, with their exposure and without; of a mean, half of its standard'
    echo 'deviation less and more. Score: mean logarithm of the density that the posterior has at the truth, waveband by waveband, more being better, the difference'
    echo 'from the first row; error: RMSE in the mean. Photographs on which nothing is fitted are in [sheets](sheets.md).'
    echo
    cargo bench --quiet --bench photograph_priors -- "$work"/*.ndjson
} | tee "$page.new"
mv "$page.new" "$page"
