#!/usr/bin/env bash
# How well folds and charts are found, in photographs that nothing was fitted to and composites of them: benches/results/find.md, in ten minutes.
# `find.sh quick` takes a third of the composites; `find.sh angle` prints the table of angles alone, in half a minute, `find.sh charts` one of charts
# alone, in all sorts of pictures that make them hard.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
. benches/peers.sh
shared=${SHARED:-../shared}
if [ ! -d "$shared/real" ]; then
    echo "benches/find.sh: no photographs in $shared; left out" >&2
    exit
fi
if ! python=$(peer numpy numpy==2.2.6 pillow); then
    echo "benches/find.sh: NumPy cannot be installed; left out" >&2
    exit
fi
cargo build --quiet --release --bin vextract
bin=${CARGO_TARGET_DIR:-target}/release
page=benches/results/find.md
pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT
made_by=$(machine "$bin/vextract")
sidecars=("$shared"/real/*.json "$shared"/real/*/*.json "$shared"/photos/*.json "$shared"/materials/*.json)
if [ "${1-}" = angle ]; then
    "$python" -B benches/find_angle.py "$bin/vextract" "${sidecars[@]}"
    exit
fi
if [ "${1-}" = charts ]; then
    "$python" -B benches/find_pictures.py "$pictures" --charts --every "${EVERY:-2}" "${sidecars[@]}"
    "$python" -B benches/find_score.py "$bin/vextract" "$pictures" charts
    exit
fi
"$python" -B benches/find_pictures.py "$pictures" --apart --every "$([ "${1-}" = quick ] && echo 12 || echo 4)" \
    "${sidecars[@]}"
{
    echo '# Folds found in photographs'
    echo
    echo "$made_by"
    echo
    echo 'Rendered photographs of folded sheets to which no weight of the search was fitted, as they are and made harder, and pictures without a fold'
    echo '(`benches/find_pictures.py`). Within: per cent of pictures whose worst corner is off by less than this share of the side of a panel. Claimed: with'
    echo 'the confidence from which vextract measures without asking; wrong: claimed with a corner off by more than 3 %. No weight was fitted to pictures'
    echo 'with tiles, stripes or the corner of a room. Charts: claimed if vextract would use them without asking; errors in distances from patch to patch,'
    echo 'wrong above 0.35.'
    echo
    "$python" -B benches/find_score.py "$bin/vextract" "$pictures"
    echo
    echo 'The angle by the corners alone, in the photographs as they are; all panels are square:'
    echo
    "$python" -B benches/find_angle.py "$bin/vextract" "${sidecars[@]}"
    echo
    echo 'Estimates with fold, angle and chart stated as a careful user knows them, and with those that `vextract --find` finds; camera and light are stated'
    echo 'in both. The finder was fitted on `train`. A chart that is turned away from the sun is used where its angle is stated, and left out where it is found.'
    echo
    "$python" -B benches/find_stated.py "$bin" "$shared"/{train,real,real/more,real/pairs,sky,ground}/*.json
} | tee "$page.new"
mv "$page.new" "$page"
