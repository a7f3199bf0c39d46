#!/bin/sh
# Mean RMSE on sets that the prior was not made of, with the Munsell chips alone and with all kinds.
# Further sets are CSV files given as arguments.
set -eu
cd "$(dirname "$0")/.."
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
echo '| set | facet noise | chips alone | all kinds |'
echo '|---|---|---|---|'
for set in cc24 "$@"; do
    for noise in 0 1e-3 1e-2; do
        printf '| %s | %s | ' "$(basename "$set" .csv)" $noise
        "$bin/vkernel" | "$bin/vforward" --reflectance "$set" --camera canon-5d-mark-ii --noise-sd $noise |
            cargo bench --quiet --bench priors | sed 's/$/ |/'
    done
done
