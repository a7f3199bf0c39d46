# Every score, under several lights, by the angle of the fold and by a field that some samples lack; colours with their error bars. Of estimates
# that are given, so that digits stay.
for angle in 30 60; do
    vkernel --angle-deg $angle --facets 4x4 | vforward --reflectance cc24:red cc24:blue-sky
done > truth.ndjson
python3 - <<'END' > samples.ndjson
import json
for place, line in enumerate(open("truth.ndjson")):
    record = json.loads(line)
    if record["kind"] == "sample":
        # an estimate as no prior makes it: off by a slope and a little, with errors of neighbours alike
        truth = record["truth"]
        bands = range(len(truth["reflectance"]))
        reflectance = [r * (1.02 - 0.0004 * place * n) + 0.003 for n, r in zip(bands, truth["reflectance"])]
        sd = [0.004 + 0.0001 * n for n in bands]
        covariance = [[sd[n] * sd[m] * 0.9 ** abs(n - m) for m in bands] for n in bands]
        estimate = {"wavelengths_nm": truth["wavelengths_nm"], "reflectance": reflectance, "reflectance_sd": sd, "covariance": covariance}
        record["estimate"] = estimate
    print(json.dumps(record, separators=(",", ":")))
END
vscore samples.ndjson --table --metrics rmse,gfc,angle,ciede2000,metamerism --illuminant D65 --illuminant A --by geometry.angle_deg
vscore samples.ndjson --table --metrics gfc --by truth.interpolation 2>&1 >/dev/null || echo "status $?"
sed '2s/"exposure":1.0/"exposure":2.0/; 3s/"exposure":1.0,//' samples.ndjson | vscore --no-history --metrics angle --by exposure | tail -n 1
vscore samples.ndjson --colour --illuminant D50 | sed -n '2s/.*"colour"://p' | sed 's/}.*/}/'
sed 's/"covariance":\[\[.*\]\]/"covariance":null/' samples.ndjson | vscore --colour --illuminant D50 | sed -n '2s/.*"colour"://p' | sed 's/}.*/}/'
