#!/usr/bin/env bash
# How well folds and charts are found, in photographs that nothing was fitted to and composites of them: benches/results/find.md, in ten minutes.
# `find.sh quick` takes a third of the composites; `find.sh angle` prints the table of angles alone, in half a minute, `find.sh charts` one of charts
# alone, in all the kinds of pictures that make them hard.
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
    echo 'Rendered photographs of folded sheets to which no weight of the search was fitted, as they are and made harder, and as many pictures without'
    echo 'a fold (`benches/find_pictures.py`). Per cent of pictures whose worst corner is within so much of a panel'"'"'s side; claimed: said with the'
    echo 'confidence from which on vextract measures without asking; wrong: a corner more than 3 % off. Of tiles, stripes and the corner of a room'
    echo 'there was no picture when the weights were fitted. Charts: claimed if vextract would use them without asking; errors in distances from patch to'
    echo 'patch, wrong above 0.35.'
    echo
    "$python" -B benches/find_score.py "$bin/vextract" "$pictures"
    echo
    echo 'How far the folds are open by their corners alone, in the photographs as they are, of which all are of square panels:'
    echo
    "$python" -B benches/find_angle.py "$bin/vextract" "${sidecars[@]}"
    echo
    echo 'Photographs with fold, angle and chart told as a careful user has them, and found, camera and light told in both; `train` is what finding was'
    echo 'fitted on. A chart that is turned from the sun is used where it is told how far, and left out where it is found.'
    echo
    "$python" -B benches/find_stated.py "$bin" "$shared"/{train,real,real/more,real/pairs,sky,ground}/*.json
} | tee "$page.new"
mv "$page.new" "$page"
