# tolerance 1e-3 2e-4
# Estimates as files of spectra: the table has the records' numbers, and what is written is read again. Of reflectances, near the true ones,
# digits are left out.
vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:green --wavelengths-nm 400:700:20 |
    vestimate --spectra two.csv | vscore --spectra two.sp -o two.ndjson
head -n 2 two.ndjson | vscore --spectra red.spdx -o red.ndjson
head -n 1 two.csv
python3 - <<'END'
import json
table = [[float(cell) for cell in line.split(",")] for line in open("two.csv").readlines()[1:]]
records = [json.loads(line) for line in open("two.ndjson")]
scene, samples = records[0], [record for record in records if record["kind"] == "sample"]
columns = [scene["wavelengths_nm"], *(one["estimate"][name] for one in samples for name in ("reflectance", "reflectance_sd"))]
print("as the records:", [list(row) for row in zip(*columns)] == table)
print("off by at most 0.1:", all(abs(r - t) < 0.1 for one in samples for r, t in zip(one["estimate"]["reflectance"], one["truth"]["reflectance"])))
END
sed -n '1,/BEGIN_DATA$/p' two.sp
grep -v CreationDate red.spdx | head -n 12 | sed 's/>0[.0-9]*</>#</'
for file in two.csv:cc24:red two.sp:cc24:red red.spdx; do
    head -n 2 two.ndjson | vscore -q --truth $file --table | tail -n 1
done
