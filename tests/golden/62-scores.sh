# tolerance 1e-3 1e-4
# Every score, under several lights, by the angle of the fold and by a field that some samples lack; colours with their error bars.
for angle in 30 60; do
    vkernel --angle-deg $angle --facets 4x4 | vforward --reflectance cc24:red cc24:blue-sky --noise-sd 1e-3
done | vestimate --save covariance=c.npy -o samples.ndjson
vscore samples.ndjson --table --metrics rmse,gfc,angle,ciede2000,metamerism --illuminant D65 --illuminant A --by geometry.angle_deg
vscore samples.ndjson --table --metrics gfc --by truth.interpolation 2>&1 >/dev/null || echo "status $?"
sed '2s/"exposure":1.0/"exposure":2.0/; 3s/"exposure":1.0,//' samples.ndjson | vscore --no-history --metrics angle --by exposure | tail -n 1
vscore samples.ndjson --colour --illuminant D50 | sed -n '2s/.*"colour"://p' | sed 's/}.*/}/'
sed 's/"covariance":\[\[.*\]\]/"covariance":null/' samples.ndjson | vscore --colour --illuminant D50 | sed -n '2s/.*"colour"://p' | sed 's/}.*/}/'
