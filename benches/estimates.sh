#!/usr/bin/env bash
# Time and error of estimates, as a table in benches/results/estimates.md: the ColorChecker, and every set (CSV file) named as
# an argument, with three cameras, without noise and with facet noise of 1e-3 of white: six minutes on one thread.
set -euo pipefail
cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-target}
cargo build --quiet --release --bins --benches
bin=$target/release
. benches/peers.sh
. benches/machine.sh
table=benches/results/estimates.md

rows() {
    for set in cc24 "$@"; do
        for camera in canon-5d-mark-ii sigma-sd-merrill nikon-d5100; do
            for noise in 0 1e-3; do
                # The paper's estimator with the power of ten that suits the noise best.
                case $noise in 0) smoothness=1e-8 ;; *) smoothness=1e-3 ;; esac
                printf '| %s | %s | %s | ' "$(basename "$set" .csv)" $camera $noise
                "$bin/vkernel" | "$bin/vforward" --reflectance "$set" --camera $camera --noise-sd $noise |
                    cargo bench --quiet --bench estimate -- $smoothness | sed 's/$/ |/'
            done
        done
    done
}

scipy() {
    if ! python=$(peer scipy scipy==1.14.1); then
        echo 'SciPy: pip cannot install it here; left out'
        return
    fi
    echo "The paper's objective, eq. (36) with facet noise and smoothness of 1e-3, minimised by \`vestimate --prior smooth\` and by two methods of"
    echo 'SciPy 1.14.1 (`benches/scipy_estimate.py`):'
    echo
    "$bin/vkernel" --mesh facets |
        "$bin/vforward" --reflectance cc24:blue-sky cc24:orange cc24:neutral-5 --noise-sd 1e-3 |
        "$bin/vestimate" --prior smooth --smoothness 1e-3 | "$python" benches/scipy_estimate.py --smoothness 1e-3
    echo
    echo "What SciPy's least squares within bounds (trf) takes for each of the 24 sheets through the first camera: mean, median, 95th percentile"
    echo 'and worst, ms, beside those of the first two rows above.'
    echo
    echo '| facet noise | smoothness | RMSE | ms |'
    echo '|---|---|---|---|'
    for noise in 0 1e-3; do
        case $noise in 0) smoothness=1e-8 ;; *) smoothness=1e-3 ;; esac
        printf '| %s | %s ' $noise $smoothness
        "$bin/vkernel" --mesh facets | "$bin/vforward" --reflectance cc24 --camera canon-5d-mark-ii --noise-sd $noise |
            "$python" benches/scipy_estimate.py --smoothness $smoothness --times
    done
}

{
    echo '# Estimates'
    echo
    machine "$bin/vkernel"
    echo
    echo '45°, 10 x 10 facets per panel, D65, exposure known, one thread.'
    echo "Mean RMSE and CIEDE2000 (10°, D65); processor time per estimate (mean, median, 95th percentile and worst, ms) and mean iterations; the four"
    echo "columns on the right are the paper's estimator"
    echo '(`--prior smooth`).'
    echo
    echo '| set | camera | facet noise | RMSE | CIEDE2000 | ms | iterations | RMSE | CIEDE2000 | ms | iterations |'
    echo '|---|---|---|---|---|---|---|---|---|---|---|'
    rows "$@"
    echo
    scipy
} | tee "$table.new"
mv "$table.new" "$table"
