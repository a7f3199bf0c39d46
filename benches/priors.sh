#!/usr/bin/env bash
# Mean RMSE on sets that the prior was not made of, with the Munsell chips alone and with all classes: benches/results/priors.md.
# Further sets are CSV files named as arguments.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
page=benches/results/priors.md

rows() {
    for set in cc24 "$@"; do
        for noise in 0 1e-3 1e-2; do
            printf '| %s | %s | ' "$(basename "$set" .csv)" $noise
            "$bin/vkernel" | "$bin/vforward" --reflectance "$set" --camera canon-5d-mark-ii --noise-sd $noise |
                cargo bench --quiet --bench priors | sed 's/$/ |/'
        done
    done
}

{
    echo '# Priors'
    echo
    machine "$bin/vkernel"
    echo
    echo '45°, 10 x 10 facets per panel, Canon EOS 5D Mark II, D65, exposure known; mean RMSE with the Munsell chips alone as the prior, and with all classes of'
    echo 'the built-in one. [Sets](sets.md) has more sets, through more cameras.'
    echo
    echo '| set | facet noise | chips alone | all classes |'
    echo '|---|---|---|---|'
    rows "$@"
} | tee "$page.new"
mv "$page.new" "$page"
