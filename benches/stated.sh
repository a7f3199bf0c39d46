#!/usr/bin/env bash
# How often another light is named as likelier than the one that was stated, right or wrong: benches/results/stated.md, in five minutes. Sheets and
# photographs are those of SHARED (../shared).
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
shared=${SHARED:-../shared}
page=benches/results/stated.md
if [ ! -e "$shared/data/reflectance" ]; then
    echo "benches/stated.sh: no sheets in $shared; left out" >&2
    exit
fi
made_by=$(machine "$bin/vkernel")

{
    echo '# Stated lights that are checked'
    echo
    echo "$made_by"
    echo
    echo 'Per cent of estimates whose verdict names another light as likelier than the stated one. Computed: the sheets of'
    echo '[lights](lights.md), exposure free, in its first eight lights and in D60, LED-B2 and FL8, each told as each of the eight; daylights next to each'
    echo 'other in that list are neither right nor wrong. Photographs: `../shared/train`, in daylight told as it is, and as lamps; their threshold was fitted'
    echo 'on these, that of computed facets is what statements are taken to be worth.'
    echo
    python3 -B benches/stated.py "$bin" "$shared"
} | tee "$page.new"
mv "$page.new" "$page"
