# Scores by measurement condition: M2 is what is reflected, M1 all that the sheet sends out. Estimates that are given, so that digits stay: the first
# one found the brightener and is off by 0.01 in what is reflected, by 0.03 in all; the second did not.
printf 'nm,f\n400,0.1\n450,0.3\n500,0.1\n550,0\n700,0\n' > f.csv
vkernel --facets 1x1 --mesh facets | vforward --reflectance 0.9 0.8 --fluorescence f.csv --wavelengths-nm 400:700:50 -o truth.ndjson
python3 - <<'END' > samples.ndjson
import json
for place, line in enumerate(open("truth.ndjson")):
    record = json.loads(line)
    if record["kind"] == "sample":
        truth = record["truth"]
        estimate = {"wavelengths_nm": truth["wavelengths_nm"], "reflectance": [r - 0.01 for r in truth["reflectance"]]}
        if place == 1:
            estimate |= {
                "total_radiance_factor": [r + 0.03 for r in truth["total_radiance_factor"]],
                "total_radiance_factor_sd": [0.02] * 7,
                "fluorescence": {"peak_nm": 450, "size": 0.33, "size_sd": 0.02, "probability": 0.99},
            }
        record["estimate"] = estimate
    print(json.dumps(record, separators=(",", ":")))
END
vscore samples.ndjson --table --metrics rmse
vscore samples.ndjson --table --metrics rmse --condition M2
vscore samples.ndjson --table --metrics rmse --condition M1
vscore samples.ndjson --no-history --metrics rmse --condition M1 | cut -d , -f 1-3 | tail -n 1
# an instrument's M1: what it measured is no reflectance
printf 'nm,0.9,0.8\n400,100,90\n450,120,110\n500,100,90\n550,90,80\n700,90,80\n' > M1.csv
sed 's/"truth":{[^}]*},//' samples.ndjson > bare.ndjson
vscore -q bare.ndjson --truth M1.csv --metrics rmse --condition m1 --no-history | tail -n 3 | grep -o '"truth"\|"metrics":{[^}]*}'
vscore -q samples.ndjson --truth M1.csv --metrics rmse --condition M1 --no-history | sed -n 2p | grep -o '"truth":{[^}]*}'
vscore samples.ndjson --truth M1.csv 2>&1 || echo $?
sed '2s/"total_radiance_factor":\[1.0[0-9]*,/"total_radiance_factor":[-1,/' samples.ndjson | vscore --condition M1 2>&1 >/dev/null || echo $?
sed '2s/"total_radiance_factor_sd":\[0.02,/"total_radiance_factor_sd":[/' samples.ndjson | vscore 2>&1 >/dev/null || echo $?
