#!/usr/bin/env bash
# What does a tenth of the error cost? Time against error of the kernel, the response, the estimate and of all tools together, at
# every setting of what steers them, other libraries beside them, and how the kernel grows with the facets: tables and drawings in
# benches/results, about ten minutes. Time is the processor's, one thread.
#
#   benches/pareto.sh [kernel|response|estimate|pipeline|photographs|growth]... [SET.csv]...    all by default, and the ColorChecker
#
# Photographs of real sheets are those of ../shared, packages of other libraries come from pip: what is not there is left out. Further sets of
# reflectances are CSV files.
set -euo pipefail
cd "$(dirname "$0")/.."
. benches/peers.sh
cargo build --quiet --release --bins --bench pareto
bin=$(realpath "${CARGO_TARGET_DIR:-target}")/release
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
camera='--camera canon-5d-mark-ii'
noises='0 1e-3'
sets=()

measure() {
    cargo bench --quiet --bench pareto -- "$@"
}

# draw STAGE: reads rows, and leaves table and drawing. Whoever else used the processor is in the table.
draw() {
    { echo "# load of $(nproc) processors beside it: $(cut -d' ' -f1-3 /proc/loadavg)"; cat; } | measure draw "$1"
}

left_out() {
    echo "$1: ${2:-pip cannot install it here}; left out" >&2
}

kernel() {
    measure kernel
    if python=$(peer pyviewfactor pyviewfactor==1.1.0); then
        "$bin/vkernel" --mesh facets --save kernel="$work/kernel.npy" >/dev/null
        "$python" benches/pyviewfactor_kernel.py "$work/kernel.npy" "$work/pyviewfactor.csv"
        awk -F, '/^#/ { print } NR > 2 { print "45°,pyviewfactor," $1 "," $2 "," $3 }' "$work/pyviewfactor.csv"
    else
        left_out pyviewfactor
    fi
}

response() {
    measure response
    if python=$(peer scipy scipy==1.14.1); then
        "$bin/vkernel" --mesh facets --save kernel="$work/kernel.npy" >/dev/null
        "$python" benches/pareto_peers.py response "$work/kernel.npy" 'solver: 100 patches x 61 wavebands'
    else
        left_out NumPy
    fi
}

estimate() {
    measure estimate "${sets[@]}"
    for noise in $noises; do
        "$bin/vkernel" | "$bin/vforward" --reflectance cc24 $camera --noise-sd $noise >"$work/samples.ndjson"
        case $noise in 0) smoothness=1e-8 ;; *) smoothness=1e-2 ;; esac
        python=$(peer scipy scipy==1.14.1) || left_out SciPy
        [ -z "$python" ] || "$python" benches/pareto_peers.py estimate $smoothness "cc24: facet noise $noise" <"$work/samples.ndjson"
    done
    # The true XYZ knows no noise.
    python=$(peer colour colour-science==0.4.7 scipy==1.14.1) || left_out colour-science
    [ -z "$python" ] || "$python" benches/pareto_peers.py colour 'cc24: facet noise 0' 'cc24: facet noise 1e-3' <"$work/samples.ndjson"
}

# run SERIES SETTING VKERNEL-FLAGS VESTIMATE-FLAGS [VFORWARD-FLAGS]: all tools on the chart, five times. The facets are those of a fold
# that is solved as closely as can be, so that the error is that of a scene solved less closely as well.
run() {
    grid=$(echo "$3" | sed -n 's/.*\(--facets [0-9x]*\).*/\1/p')
    optics="--reflectance cc24 $camera --noise-sd $noise"
    "$bin/vkernel" --tolerance 1e-7 $grid | "$bin/vforward" $optics | tail -n +2 >"$work/truth.ndjson"
    "$bin/vkernel" $3 | "$bin/vforward" $optics ${5:-} | head -n 1 | cat - "$work/truth.ndjson" |
        "$bin/vestimate" -q $4 | "$bin/vscore" >"$work/scores.ndjson"
    times() {
        for _ in 1 2 3 4 5; do
            "$bin/vkernel" -j 1 $3 | "$bin/vforward" -j 1 $optics ${5:-} | "$bin/vestimate" -q -j 1 $4 | "$bin/vscore" -j 1 >"$work/out"
        done
    }
    TIMEFORMAT='%U %S'
    { time times "$@"; } 2>"$work/seconds"
    tail -n 1 "$work/scores.ndjson" | awk -v series="$1" -v setting="$2" -v panel="24 sheets: facet noise $noise" -v took="$(tail -n 1 "$work/seconds")" '
        { split(took, of, " "); match($0, /"rmse":\{[^}]*"mean":[0-9.e-]+/); error = substr($0, RSTART, RLENGTH); sub(/.*:/, "", error)
          printf "%s,%s,%s,%.3e,%.3e\n", panel, series, setting, 1e3 * (of[1] + of[2]) / 5, error }'
}

pipeline() {
    for noise in $noises; do
        for tolerance in 1e-2 1e-3 1e-4 1e-5 1e-6; do
            run 'vkernel --tolerance' $tolerance "--tolerance $tolerance" ''
        done
        run 'vkernel --mesh facets' '' '--mesh facets' ''
        for facets in 2x2 4x4 20x20; do
            run 'vkernel --tolerance 1e-3 --facets' $facets "--tolerance 1e-3 --facets $facets" ''
        done
        case $noise in 0) smoothness=1e-8 ;; *) smoothness=1e-2 ;; esac
        run 'vestimate --prior smooth' $smoothness '--tolerance 1e-3' "--prior smooth --smoothness $smoothness"
    done
}

photographs() {
    python3 benches/photographs.py "$bin" ../shared
}

stages=
for argument in "$@"; do
    case $argument in
        *.csv) sets+=("$(realpath "$argument")") ;;
        *) stages="$stages $argument" ;;
    esac
done
for stage in ${stages:-kernel response estimate pipeline photographs growth}; do
    echo "$stage" >&2
    case $stage in
        photographs) [ -e ../shared/real ] || { left_out photographs '../shared is not there' && continue; } ;;&
        kernel | response | estimate | pipeline | photographs) "$stage" | draw "$stage" ;;
        growth) measure growth ;;
        *) echo "benches/pareto.sh: there is no stage '$stage'" >&2 && exit 2 ;;
    esac
done
