# One scene line and independent samples: a stream can be dealt out to many machines and put together again.
vkernel --facets 3x3 | vforward --reflectance cc24 -o samples.ndjson
vestimate samples.ndjson -o whole.ndjson
head -n 1 whole.ndjson > parts.ndjson
for first in 2 14; do
    { head -n 1 samples.ndjson; tail -n +$first samples.ndjson | head -n 12; } | vestimate | tail -n +2 >> parts.ndjson
done
tail -n +2 whole.ndjson | cksum > whole.sum
tail -n +2 parts.ndjson | cksum | cmp - whole.sum && echo "the same bytes"
