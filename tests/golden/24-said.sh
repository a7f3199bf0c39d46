# What vestimate -v says of a sample: noise from each of its sources, what was fitted, and methods without error bars. Numbers that the
# prior or rounding decides are left out.
vkernel --angle-deg 45 --facets 4x4 -o scene.json
vforward scene.json --reflectance cc24:orange --noise-sd 1e-3 -o sample.ndjson
vforward scene.json --reflectance cc24:orange -o exact.ndjson
vkernel --angle-deg 180 --facets 1x1 | vforward --reflectance cc24:orange -o flat.ndjson
said() {
    vestimate "$@" -v 2>&1 >/dev/null | sed -E 's/[0-9]* iterations/# iterations/; s/(residual|reflectance known to|at worst|±) [0-9.]+/\1 #/g; s/ [0-9.]+ ±/ # ±/g'
}
said sample.ndjson
said sample.ndjson --noise-sd 2e-3 --exposure free
said sample.ndjson --model-error 1e-3
said sample.ndjson --fit tilt,sky
said sample.ndjson --prior smooth
said sample.ndjson --prior smooth --smoothness auto
said exact.ndjson | sed 's/facets known to [^ ]*/facets known to #/; s/; residual [0-9].*//'
said flat.ndjson --method khan | sed 's/residuals [^ ]*/residuals #/'
