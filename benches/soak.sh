#!/usr/bin/env bash
# Does memory stay flat? Many samples through all tools at once, a tenth of them first: benches/results/soak.md. soak.sh [N], N = 300000
# unless given, takes N milliseconds and more; TOOLS is a folder of tools to take as they are. Needs GNU time (apt-get install time).
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/machine.sh
if [ -z "${TOOLS:-}" ]; then
    cargo build --quiet --release --bins
    TOOLS=${CARGO_TARGET_DIR:-target}/release
fi
PATH=$(cd "$TOOLS" && pwd):$PATH
page=$PWD/benches/results/soak.md
many=${1:-300000}
head=$(machine vkernel)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# timed NAME COMMAND...: the command, and in the file NAME its peak memory in kB
timed() {
    local file=$1
    shift
    command time -o "$file" -f %M "$@"
}

# Samples: the 1269 Munsell chips under one seed of the noise after the other, in one scene.
samples() {
    vforward scene.json --reflectance 0.5 --no-history | head -n 1
    for ((seed = 0; seed * 1269 < $1; seed++)); do
        vforward scene.json --reflectance munsell --noise-sd 1e-3 --seed $seed --no-history | tail -n +2
    done
}

row() { # WHAT COUNT FILE
    local mb few
    mb=$(($(cat "$3") / 1024))
    few=$(($(cat "few/$3") / 1024))
    echo "| $1 | $2 | $few | $mb |"
}

# run N: all tools on N samples, and vextract on a hundredth of that many photographs
run() {
    samples "$1" | timed vestimate vestimate -q | timed vscore vscore | tail -n 1 >summary
    grep -o '"samples":[0-9]*' summary | head -n 1 | cut -d: -f2 >scored
    rm -rf photographs
    mkdir photographs
    for ((k = 0; k < $1 / 100; k++)); do ln -s ../photo.tif photographs/$k.tif; done
    find photographs -name '*.tif' >names
    eval "timed vextract vextract --files-from names --scene scene.json --camera canon-5d-mark-ii $corners" | wc -l >extracted
}

vkernel --no-history -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 0.5 --noise-sd 3e-3 --render photo.tif --render-size 320x240 2>corners >/dev/null
corners=$(grep -o -- '--panel0.*' corners)
mkdir few
tenth=$((many / 10))
run "$tenth"
mv vestimate vscore vextract few/
run "$many"
{
    echo '# Soak'
    echo
    echo "$head"
    echo
    echo "\`benches/soak.sh $many\`: samples of 10 x 10 facets per panel through vforward, vestimate and vscore in one pipeline, photographs of 320 x 240 px"
    echo 'through vextract. Memory is the peak of the process; vscore keeps the scores of all samples, some 40 bytes each, for their median.'
    echo
    echo '| tool | records | peak MB, a tenth of the records | peak MB, all |'
    echo '|---|---|---|---|'
    row vestimate "$(cat scored)" vestimate
    row vscore "$(cat scored)" vscore
    row vextract "$(($(cat extracted) - 1))" vextract
} >"$page.new"
mv "$page.new" "$page"
cat "$page"
