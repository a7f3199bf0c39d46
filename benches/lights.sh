#!/usr/bin/env bash
# Ideal folds whose light is stated rightly, unknown, or stated wrongly, and flat patches, by light and by noise: benches/results/lights.md, in five
# minutes. The sheets are those of SHARED (../shared).
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
shared=${SHARED:-../shared}
page=benches/results/lights.md
if [ ! -e "$shared/data/reflectance" ]; then
    echo "benches/lights.sh: no sheets in $shared; left out" >&2
    exit
fi
made_by=$(machine "$bin/vkernel")

{
    echo '# Light stated and unknown'
    echo
    echo "$made_by"
    echo
    echo '64 sheets: the ColorChecker and five of each other set of `data/reflectance`; 45°, 10 x 10 facets per panel, Canon EOS 5D Mark II,'
    echo 'exposure free. Identified: per cent of estimates of an unknown light whose expected spectrum is nearer to the true light than to any other of the'
    echo 'first eight of the table; likewise with one flat patch. Of eight: per cent in which the true light is the most probable, if these eight alone are'
    echo 'candidates, equally probable. Then RMSE and per cent of true values within two standard deviations, with the light stated rightly, unknown, known to be'
    echo 'one of the eight, and stated wrongly (as each other of the eight), and RMSE of the flat patch in unknown light. D60, the sun, LED-B2, FL8 and the flash'
    echo 'are not among the candidates: these are all lights of `--illuminant unknown`, without LED-B2 and FL8 where one of them is the true light.'
    echo 'The number of lights that are kept was raised once with this table in view, after other sheets of the same sets (`lights.py --pick 7`) had shown why.'
    echo 'How far searches go, and how far behind lights are dropped, was chosen by `lights.py --pick 7` and patches of the ColorChecker, which are in this table, too.'
    echo
    python3 -B benches/lights.py "$bin" "$shared"
} | tee "$page.new"
mv "$page.new" "$page"
