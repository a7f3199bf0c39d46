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
    echo '# Exposure by the settings of the camera, and by white paper'
    echo
    machine "$bin/vestimate"
    echo
    echo 'Rendered photographs without a chart or a card, three times each, their numbers taken for less light, as of those who fear'
    echo 'clipped pixels (up to a half in two of three): without settings, and with an exposure time, an aperture and a sensitivity in their EXIF that make'
    echo 'white what it is within 30 per cent, or with what vextract would say of white printing paper beside the sheet, off by 6 per cent.'
    echo
    "$python" -B benches/metered.py "$bin" "$shared"
} | tee "$page.new"
mv "$page.new" "$page"
