# tolerance 1e-3 1e-4
# Truth in a file, one column a sample; other illuminants and observers; the last record sums up. The paper's estimator knows no prior, so that
# digits stay.
cat > sheets.csv <<END
wavelength,brick,leaf
400,0.05,0.06
500,0.08,0.1
550,0.1,0.3
600,0.4,0.12
700,0.5,0.45
END
vkernel --facets 2x2 --no-history | vforward --reflectance sheets.csv --no-history | vestimate --prior smooth --no-history -o estimates.ndjson
for light in D65 A; do
    vscore estimates.ndjson --truth sheets.csv --illuminant $light --observer 2 --no-history | tail -n 1
done
