# A camera in a rawtoaces file gives what the same camera in a table gives, in any order of its wavelengths.
cat > camera.json <<'END'
{
    "header": {"schema_version": "1.0.0", "manufacturer": "Workshop", "model": "Pinhole"},
    "spectral_data": {
        "units": "relative",
        "index": {"main": ["R", "G", "B"]},
        "data": {
            "main": {
                "500": [0.05, 0.7, 0.5],
                "400": [0.02, 0.01, 0.2],
                "450": [0.03, 0.1, 1.0],
                "600": [1.0, 0.3, 0.01],
                "550": [0.2, 0.9, 0.06],
                "700": [0.1, 0.02, -0.0005],
                "650": [0.6, 0.05, 0.004]
            }
        }
    }
}
END
cat > camera.csv <<'END'
wavelength,R,G,B
400,0.02,0.01,0.2
450,0.03,0.1,1.0
500,0.05,0.7,0.5
550,0.2,0.9,0.06
600,1.0,0.3,0.01
650,0.6,0.05,0.004
700,0.1,0.02,-0.0005
END
vkernel --angle-deg 45 --facets 1x1 -o scene.json
for camera in camera.json camera.csv; do
    vforward scene.json --reflectance cc24:green --camera $camera --no-history | sed "s/$camera/CAMERA/" > $camera.ndjson
done
cmp camera.json.ndjson camera.csv.ndjson && echo the same
vestimate camera.json.ndjson | vscore --table | below RMSE=0.03 CIEDE2000=1.5 PD=0.01
