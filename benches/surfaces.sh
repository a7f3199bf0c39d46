#!/usr/bin/env bash
# Surfaces of many facets: time, memory and error of the whole of vkernel, one thread: benches/results/surfaces.md, in some six
# minutes. Needs GNU time (apt-get install time); NumPy comes from pip.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/peers.sh
cargo build --quiet --release --bins
PATH=$(cd "${CARGO_TARGET_DIR:-target}/release" && pwd):$PATH
python=$(peer numpy numpy==2.2.6)
shapes=$PWD/benches/surfaces.py table=$PWD/benches/results/surfaces.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# measure WHAT FACETS FLAG...: makes scene.json; its row of the table but for the error
measure() {
    local row="| $1 | $2 |"
    shift 2
    command time -o took -f '%U %S %M' vkernel -j 1 --mesh facets --no-history -o scene.json "$@"
    awk -v row="$row" '{ printf "%s %.2g | %.0f |", row, $1 + $2, $3 / 1024 }' took
}

off() { echo " $("$python" "$shapes" "$@") |"; }

sheet() { # ROWS
    measure 'three panels, 60° and 80°' $((3 * $1 * $1)) --folds 2 --angle-deg 60 --ridge-deg 80 --facets "$1x$1"
}

box() { # SQUARES A SIDE'S EDGE
    "$python" "$shapes" box "$1" > box.obj
    measure 'closed box, lamp in it' $((6 * $1 * $1)) --shape box.obj --light point:0.5,0.3,0.7
    off flux scene.json
}

crumpled() { # SQUARES AN EDGE
    "$python" "$shapes" crumpled "$1" > crumpled.obj
    measure 'crumpled sheet, low sun' $((2 * $1 * $1)) --shape crumpled.obj --light 0.3,0.2,1
}

rows() {
    sheet 32
    vkernel -q --mesh facets --folds 2 --angle-deg 60 --ridge-deg 80 --facets 32x32 --save kernel=all.npy >/dev/null
    off dense scene.json all.npy
    rm all.npy
    for rows in 82 129 182; do sheet $rows && echo ' |'; done
    for squares in 23 59 91; do box $squares; done
    crumpled 15
    vkernel -q --mesh facets --shape crumpled.obj --light 0.3,0.2,1 --tolerance 1e-4 -o better.json
    off against scene.json better.json
    for squares in 25 40; do crumpled $squares && echo ' |'; done
}

{
    echo '# Surfaces of many facets'
    echo
    echo "vfold $(vkernel --version | cut -d' ' -f2), $(rustc --version | cut -d' ' -f1,2), $(nproc) cores of$(sed -n 's/^model name.*://p' /proc/cpuinfo | head -n 1), $(date +%F), load $(cut -d' ' -f1 /proc/loadavg);"
    echo 'one flat patch per facet, default tolerance (5e-3). Processor time and peak memory of the whole of vkernel on one thread. Errors at reflectance 0.9:'
    echo 'of the box, the light of all bounces against the direct light over 1 - r; of the three panels, root mean square against all pairs, solved by NumPy;'
    echo 'of the crumpled sheet, root mean square against a tolerance of 1e-4.'
    echo
    echo '| what | facets | s | peak MB | relative error |'
    echo '|---|---|---|---|---|'
    rows
} | tee "$table.new"
mv "$table.new" "$table"
