# tolerance 1e-3 2e-4
# The paper's estimator (eq. (36)) beside the default one, on a fold of flat facets as in the paper.
vkernel --mesh facets | vforward --reflectance cc24:red cc24:foliage -o samples.ndjson
for prior in smooth munsell; do
    vestimate samples.ndjson --prior $prior | vscore --table
done
