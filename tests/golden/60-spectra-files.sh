# One paint in every format: all give the facets that the plain table gives, and what was converted is said once.
cat > paint.csv <<END
wavelength,red,dark
400,0.0625,0.03125
500,0.125,0.03125
600,0.5,0.0625
700,0.75,0.0625
END
cat > percent.csv <<END
wavelength [um],red,red_sd,dark
0.4,6.25,1,3.125
0.5,12.5,1,3.125
0.6,50,1,6.25
0.7,75,1,6.25
END
cat > argyll.sp <<END
SPECT

ORIGINATOR "a workshop"
SPECTRAL_BANDS "4"
SPECTRAL_START_NM "400.0"
SPECTRAL_END_NM "700.0"
SPECTRAL_NORM "100.0"

NUMBER_OF_FIELDS 5
BEGIN_DATA_FORMAT
SAMPLE_ID SPEC_400 SPEC_500 SPEC_600 SPEC_700
END_DATA_FORMAT

NUMBER_OF_SETS 2
BEGIN_DATA
"red" 6.25 12.5 50 75
dark 3.125 3.125 6.25 6.25 # matt
END_DATA
END
cat > export.txt <<END
CGATS.17
ORIGINATOR	"i1Profiler"
NUMBER_OF_FIELDS	6
BEGIN_DATA_FORMAT
SAMPLE_ID	SAMPLE_NAME	SPECTRAL_NM400	SPECTRAL_NM500	SPECTRAL_NM600	SPECTRAL_NM700
END_DATA_FORMAT
NUMBER_OF_SETS	2
BEGIN_DATA
red	A1	0.0625	0.125	0.5	0.75
dark	A2	0.03125	0.03125	0.0625	0.0625
END_DATA
END
cat > aces.json <<END
{"spectral_data": {"index": {"main": ["red", "dark"]}, "data": {"main": {
  "400": [0.0625, 0.03125], "500": [0.125, 0.03125], "700": [0.75, 0.0625], "600": [0.5, 0.0625]}}}}
END
cat > red.spdx <<END
<?xml version="1.0"?>
<IESTM2714 xmlns="http://www.ies.org/iestm2714" version="1.0">
  <Header><Description>red</Description></Header>
  <SpectralDistribution>
    <SpectralQuantity>reflectance</SpectralQuantity>
    <SpectralData wavelength="400">0.0625</SpectralData>
    <SpectralData wavelength="500">0.125</SpectralData>
    <SpectralData wavelength="600">0.5</SpectralData>
    <SpectralData wavelength="700">0.75</SpectralData>
  </SpectralDistribution>
</IESTM2714>
END
vkernel --facets 1x1 --no-history -o scene.json
facets() { vforward scene.json --no-history --reflectance "$@" 2>said | sed -n 's/.*"facet_rgb":\([^}]*\),"exposure.*/\1/p'; }
facets paint.csv > expected
for file in percent.csv argyll.sp export.txt aces.json; do
    facets $file > found
    cmp expected found && echo "$file is the same" && cat said
done
facets red.spdx | cat - said
facets argyll.sp:red
vforward scene.json -q --reflectance percent.csv percent.csv:dark --no-history | sed -n 's/.*"id":"\([^"]*\)".*/\1/p'

# the same files by name, in a directory of one's own; a built-in name stays what it is
mkdir own
cp paint.csv own/
cp red.spdx own/D65.spdx
export VFOLD_DATA=own
vforward --list cameras | grep own
facets paint:red
vforward scene.json --reflectance 0.5 --illuminant d65 2>&1 >/dev/null
