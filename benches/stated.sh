#!/usr/bin/env bash
# How often another light is named as more probable than the stated one, rightly or wrongly: benches/results/stated.md, in five minutes. Sheets and
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
    echo '# How stated lights are checked'
    echo
    echo "$made_by"
    echo
    echo 'Per cent of estimates whose verdict names another light as more probable than the stated one. Computed: the sheets of [lights](lights.md),'
    echo 'exposure free, in its first eight lights and in D60, LED-B2 and FL8, each stated as each of the eight; neighbouring daylights of that list count as'
    echo 'neither right nor wrong. Photographs: `../shared/train`, their daylight stated as it is, and as lamps; their threshold was fitted on these, that of'
    echo 'computed facets follows from how many statements are assumed to be wrong. Charts: per cent by which the patches of those of the same photographs'
    echo 'are off, root mean square of the worst channel; from these the limit was set above which a chart contradicts light or camera.'
    echo
    python3 -B benches/stated.py "$bin" "$shared"
} | tee "$page.new"
mv "$page.new" "$page"
