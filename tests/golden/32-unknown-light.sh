# A light that nobody knows: forgotten by vestimate, the one candidate where there is but one, and refused where it has to be known.
vkernel --angle-deg 45 | vforward --reflectance cc24:orange cc24:light-skin cc24:foliage --illuminant A --noise-sd 1e-3 -o told.ndjson
vestimate -q told.ndjson --illuminant unknown --exposure free -o found.ndjson
head -n 1 found.ndjson | grep -o '"illuminant_unknown":true'
grep -c illuminants found.ndjson || true
vscore found.ndjson --table | below RMSE=0.06 CIEDE2000=8 PD=0.06
vestimate -q told.ndjson --illuminant unknown --illuminants A --exposure free |
    grep -o '"candidates":[^]]*]' | tail -n 1 | sed 's/:0\.99999999[0-9]*}/:1.0}/' # shares add up to 1 but for rounding
vforward --illuminant unknown --reflectance 0.5 told.ndjson 2>&1 || true
vestimate --illuminant D65 told.ndjson 2>&1 || true
