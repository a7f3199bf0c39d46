# tolerance 1e-3 2e-4
# The paper's estimator (eq. (36)) beside the default one, on a fold of flat facets as in the paper.
vkernel --mesh facets | vforward --reflectance cc24:red cc24:foliage -o samples.ndjson
vestimate samples.ndjson --prior smooth | vscore --table
vestimate samples.ndjson --prior munsell | vscore --table | below RMSE=0.02,0.01 CIEDE2000=0.3 PD=0.01
