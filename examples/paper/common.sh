# Sourced by the scripts of this folder: the tools, a folder for results, and what all sections share.
set -eu
project=$(cd "$(dirname "$0")/../.." && pwd)
PATH=$project/examples/paper:$PATH
# TOOLS: set where the tools are on the path already
if [ -z "${TOOLS:-}" ]; then
    cargo build --quiet --release --bins --example paper-plot --manifest-path "$project/Cargo.toml"
    target=$(cargo metadata --format-version 1 --no-deps --manifest-path "$project/Cargo.toml" |
        sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
    PATH=$target/release:$target/release/examples:$PATH
fi
mkdir -p vfold-paper
cd vfold-paper

# The paper's camera is a Sigma SD-10, whose sensitivities are not published; this is a later one with the same type of sensor.
camera=${CAMERA:-sigma-sd-merrill}
# The paper's weight of smoothness, 2.5, has the unit of its pictures, which it does not give; here white is 1.
smooth='--prior smooth --smoothness 1e-6'
# Three lights: the primaries of a display, and common lamps.
display='--illuminant LCD-R --illuminant LCD-G --illuminant LCD-B'
lamps='--illuminant A --illuminant D65 --illuminant FL11'

# Mean RMSE, CIEDE2000 and PD of the estimates on standard input.
means() {
    vscore --table "$@" | awk '$1 == "mean" { print $2, $3, $4 }'
}

# RMSE / CIEDE2000 of the estimates on standard input, for a cell.
cell() {
    means "$@" | awk '{ printf "%.4f / %.3f", $1, $2 }'
}

# The samples of the stream $2 under the scene of the stream $1: what they are taken for.
taken_for() {
    head -n 1 "$1"
    tail -n +2 "$2"
}

# A flat sheet facing the sun: one facet a panel, no bounces.
flat() {
    vkernel --angle-deg 180 --facets 1x1 "$@"
}
