#!/bin/sh
# Time and error of every kernel and of the bounces, of what is skipped, and of whole runs of vkernel: tables and drawings in
# benches/results, about five minutes. pyviewfactor takes part where pip can install it.
set -eu
cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-target}
. benches/peers.sh
cargo build --quiet --release --bins --benches
kernel=$(mktemp)
trap 'rm -f "$kernel"' EXIT
"$target/release/vkernel" --mesh facets --save kernel="$kernel" >/dev/null
if python=$(peer pyviewfactor pyviewfactor==1.1.0); then
    echo pyviewfactor >&2
    "$python" benches/pyviewfactor_kernel.py "$kernel" benches/results/pyviewfactor.csv
    "$python" benches/pyviewfactor_shapes.py "$target/release/vkernel" tests/data/shapes/*.obj \
        >benches/results/pyviewfactor_shapes.csv
else
    echo 'pyviewfactor: pip cannot install it here; left out' >&2
    rm -f benches/results/pyviewfactor.csv
fi
cargo bench --quiet --bench kernel
cargo bench --quiet --bench skips
cargo bench --quiet --bench timings
