#!/bin/bash
# Batches: samples per second, memory and their growth with the number of samples, on threads and on hosts; photographs of 24
# megapixels and of real sheets; bytes per record. batch.sh [N] goes up to N (100000) samples and writes benches/results/batch.md and
# batch.csv. Some seven minutes on two cores, half of them for N/10 photographs of real sheets; needs GNU time, GNU parallel,
# oiiotool, sshd and zstd (apt-get install time parallel openimageio-tools openssh-server zstd) and 6 GB in $TMPDIR.
set -euo pipefail
cd "$(dirname "$0")/.."
cargo build --quiet --release --bins
PATH=$(cd "${CARGO_TARGET_DIR:-target}/release" && pwd):$PATH
cluster=$PWD/examples/cluster csv=$PWD/benches/results/batch.csv table=$PWD/benches/results/batch.md
work=$(mktemp -d)
trap 'cat "$work"/*.pid 2>/dev/null | xargs -r kill; rm -rf "$work"' EXIT
cd "$work"
many=${1:-100000} some=$((${1:-100000} / 10)) few=$((${1:-100000} / 100))

# measure WHAT SAMPLES THREADS HOSTS COMMAND: a row of the CSV
measure() {
    local row="$1,$2,$3,$4"
    shift 4
    command time -o took -f '%e %U %S %M' "$@" > out 2> said || { [ $? = 3 ] || cat said >&2; }
    awk -v row="$row" '{ split(row, r, ","); printf "%s,%.2f,%.3g,%.3g,%.0f\n", row, $1, r[2] / $1, 1000 * ($2 + $3) / r[2], $4 / 1024 }' \
        took | tee -a "$csv"
}

# samples N: the first N of 1269 Munsell chips under one seed of the noise after the other
samples() {
    vforward scene.json --reflectance munsell --noise-sd 1e-3 --no-history | head -n 1
    for ((seed = 0; seed * 1269 < $1; seed++)); do
        vforward scene.json --reflectance munsell --noise-sd 1e-3 --seed $seed --no-history | tail -n +2
    done | head -n "$1" || true # vforward is not at its end
}

hosts() {
    ssh-keygen -q -t ed25519 -N '' -f host_key
    ssh-keygen -q -t ed25519 -N '' -f user_key
    [ "$(id -u)" != 0 ] || mkdir -p /run/sshd
    for host in 127.0.0.1 127.0.0.2; do
        printf '%s\n' "ListenAddress $host:22022" "HostKey $work/host_key" "AuthorizedKeysFile $work/user_key.pub" \
            "PidFile $work/$host.pid" 'StrictModes no' 'UsePAM no' > $host.conf
        /usr/sbin/sshd -f $host.conf -E $host.log
        echo "1/$host" >> hosts
    done
    export PARALLEL_SSH="ssh -F none -i $work/user_key -p 22022 -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null -o LogLevel=ERROR"
}

vkernel --no-history -o scene.json
echo 'what,samples,threads,hosts,seconds,samples_per_s,cpu_ms_per_sample,peak_MB' > "$csv"
samples "$many" > "$many.ndjson"
for n in $few $some; do head -n $((n + 1)) "$many.ndjson" > "$n.ndjson"; done

# vestimate
for threads in 1 2; do
    for n in $few $some; do measure vestimate "$n" "$threads" 1 vestimate -j "$threads" "$n.ndjson"; done
done
measure vestimate "$many" 2 1 vestimate -j 2 "$many.ndjson"
measure 'vestimate --fit exposure tilt sky' "$few" 2 1 vestimate -q -j 2 --fit exposure,tilt,sky "$few.ndjson"
measure 'vestimate by GNU parallel' "$some" 2 1 "$cluster/parallel/estimate" < "$some.ndjson"
hosts
measure 'vestimate by GNU parallel over ssh' "$some" 1 2 "$cluster/parallel/estimate" --sshloginfile hosts --env PATH < "$some.ndjson"
vestimate --no-history "$some.ndjson" > estimated.ndjson
head -n $((some / 2 + 1)) estimated.ndjson > half.ndjson
measure 'vestimate --resume of a half' "$some" 2 1 vestimate --no-history -j 2 "$some.ndjson" --resume half.ndjson
cmp half.ndjson estimated.ndjson
measure vscore "$some" 2 1 vscore -j 2 estimated.ndjson

# how long a sample takes from end to end if the next one is late
late() { { head -n 2 "$few.ndjson"; sleep 2; } | vestimate | { head -n 2 >/dev/null; date +%s%N; }; }
begin=$(date +%s%N)
first_ms=$((($(late) - begin) / 1000000))

# vextract
photograph() { # SIZE FORMAT COUNT
    mkdir "$2-$1"
    for ((k = 1; k <= $3; k++)); do ln -s "../$1.$2" "$2-$1/$k.$2"; done
}
for size in 320x240 6000x4000; do
    vforward scene.json --reflectance cc24:orange --exposure 0.5 --noise-sd 3e-3 --render $size.tif --render-size $size \
        2> corners-$size >/dev/null
    eval "set -- $(grep -o -- '--panel0.*' corners-$size)"
    printf '%q ' "$@" --scene scene.json --camera canon-5d-mark-ii > flags-$size
done
oiiotool 6000x4000.tif -d uint8 --compression jpeg:95 -o 6000x4000.jpg
photograph 320x240 tif 1000
photograph 6000x4000 tif 16
photograph 6000x4000 jpg 16
for threads in 1 2; do
    eval "measure 'vextract 320x240 TIFF' 1000 $threads 1 vextract -j $threads $(cat flags-320x240) tif-320x240/*"
    eval "measure 'vextract 24 megapixels TIFF of 16 bits' 16 $threads 1 vextract -j $threads $(cat flags-6000x4000) tif-6000x4000/*"
    eval "measure 'vextract 24 megapixels JPEG' 16 $threads 1 vextract -j $threads $(cat flags-6000x4000) jpg-6000x4000/*"
done

# photographs of real sheets: rough and glossy, by daylight and by lamplight, again and again under other names
again() { # N FILE
    awk -v n="$1" 'NR == 1 { print; next } { line[++count] = $0 }
        END { for (k = 0; k < n; k++) { one = line[k % count + 1]; sub(/"id":"/, "&" k "-", one); print one } }' "$2"
}
for light in D65 A; do
    for chip in orange foliage blue-sky red yellow neutral-8 cyan magenta; do
        vforward scene.json --reflectance cc24:$chip --illuminant $light --exposure 0.5 --specular-weight 0.5 --body-roughness-deg 15 \
            --noise-sd 1e-3 --render $chip-$light.tif --render-size 320x240 >/dev/null 2>&1
    done
    eval "vextract $(cat flags-320x240) --illuminant $light ./*-$light.tif" > real-$light.ndjson
done
again "$some" real-D65.ndjson > real.ndjson
measure 'vestimate of photographs of real sheets' "$some" 2 1 vestimate -q -j 2 real.ndjson
{ again "$((few / 2))" real-D65.ndjson; again "$((few / 2))" real-A.ndjson; } > pairs.ndjson
measure 'vestimate --join of two photographs of each sheet' "$few" 2 1 vestimate -q -j 2 --join pairs.ndjson

# bytes
vestimate -q "$few.ndjson" --save facet_rgb=facet_rgb.npy --save reflectance=reflectance.npy --save reflectance_sd=sd.npy > estimates.ndjson
bytes() { echo "$1,$(($(wc -c < "$2") / $3))"; } # WHAT FILE RECORDS
zstd -q -T0 < "$few.ndjson" > samples.zst
zstd -q -T0 < estimates.ndjson > estimates.zst
gzip < estimates.ndjson > estimates.gz
eval "vextract $(cat flags-320x240) tif-320x240/*" > photographs.ndjson
vestimate -q photographs.ndjson > spectra.ndjson
sizes() {
    bytes 'computed sample' "$few.ndjson" "$few"
    bytes 'computed sample, zstd' samples.zst "$few"
    bytes 'its estimate, with the sample' estimates.ndjson "$few"
    bytes 'its estimate, zstd' estimates.zst "$few"
    bytes 'its estimate, gzip' estimates.gz "$few"
    bytes 'sample of a photograph' photographs.ndjson 1000
    bytes 'its estimate, with the sample' spectra.ndjson 1000
    bytes 'facet RGB, NPY' facet_rgb.npy "$few"
    bytes 'reflectance, NPY' reflectance.npy "$few"
    bytes 'standard deviation of reflectance, NPY' sd.npy "$few"
    bytes 'photograph of 24 megapixels, 16-bit TIFF' 6000x4000.tif 1
    bytes 'photograph of 24 megapixels, JPEG, quality 95' 6000x4000.jpg 1
}

{
    echo '# Batches'
    echo
    echo "vfold $(vkernel --version | cut -d' ' -f2), $(rustc --version | cut -d' ' -f1,2), $(nproc) cores of$(sed -n 's/^model name.*://p' /proc/cpuinfo | head -n 1), $(parallel --version | sed 's/GNU parallel/GNU parallel/;q'), $(date +%F), load $(cut -d' ' -f1 /proc/loadavg);"
    echo '45°, 10 x 10 facets per panel, facet noise 1e-3 of white. Hosts are ssh daemons on loopback that share the cores, one process each. Memory is the'
    echo 'peak of the largest process, with the file pages of programs.'
    echo
    echo '| what | samples | threads | hosts | s | samples/s | processor ms per sample | peak MB |'
    echo '|---|---|---|---|---|---|---|---|'
    tail -n +2 "$csv" | awk -F, '{ for (n = 1; n <= NF; n++) printf "| %s ", $n ~ /e[+]/ ? sprintf("%.0f", $n) : $n; print "|" }'
    echo
    awk -F, '$1 == "vestimate" && $3 == 2 { n[++rows] = $2; ms[rows] = $2 * $7; m[rows] = $8 } END {
        for (k = 2; k <= rows; k++) printf "From %d to %d samples, the processor time of vestimate grows as the power %.2f of their number, its memory from %d to %d MB.\n",
            n[k - 1], n[k], log(ms[k] / ms[k - 1]) / log(n[k] / n[k - 1]), m[k - 1], m[k] }' "$csv"
    echo "If the next sample is two seconds late, the first leaves vestimate $first_ms ms after the pipeline starts."
    echo
    echo '| record | bytes |'
    echo '|---|---|'
    sizes | sed 's/\(.*\),/| \1 | /; s/$/ |/'
} > "$table.new"
mv "$table.new" "$table"
