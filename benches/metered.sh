#!/usr/bin/env bash
# What the camera's settings and white paper show of the exposure, and what that is worth: benches/results/metered.md, in two minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
. benches/peers.sh
shared=${SHARED:-../shared}
if [ ! -d "$shared/real" ]; then
    echo "benches/metered.sh: no photographs in $shared; left out" >&2
    exit
fi
if ! python=$(peer numpy numpy==2.2.6); then
    echo "benches/metered.sh: NumPy cannot be installed; left out" >&2
    exit
fi
cargo build --quiet --release --bins
bin=${CARGO_TARGET_DIR:-target}/release
page=benches/results/metered.md
{
    echo '# Exposure by camera settings and by white paper'
    echo
    machine "$bin/vestimate"
    echo
    echo 'Rendered photographs without a chart or card, three times each, underexposed as by those who fear clipped pixels (in two of three by at most a half):'
    echo 'without settings; with exposure time, aperture and sensitivity in EXIF, which give the value of white within 30 per cent; or with what vextract would'
    echo 'measure of white printing paper next to the sheet, within 6 per cent.'
    echo
    "$python" -B benches/metered.py "$bin" "$shared"
} | tee "$page.new"
mv "$page.new" "$page"
