# tolerance 1e-3 2e-4
# Estimates as files of spectra: the table has the records' numbers, and what is written is read again.
vkernel --facets 2x2 | vforward --reflectance cc24:red cc24:green --wavelengths-nm 400:700:20 |
    vestimate --spectra two.csv | vscore --spectra two.sp -o two.ndjson
head -n 2 two.ndjson | vscore --spectra red.spdx -o red.ndjson
cat two.csv
sed -n '1,/BEGIN_DATA$/p' two.sp
grep -v CreationDate red.spdx | head -n 12
for file in two.csv:cc24:red two.sp:cc24:red red.spdx; do
    head -n 2 two.ndjson | vscore -q --truth $file --table | tail -n 1
done
