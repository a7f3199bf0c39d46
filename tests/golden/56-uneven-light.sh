# A photograph in the sun, with a shadow on a panel, and in the light of a lamp: what is wrong is named, and no verdict is good.
photo() { # what vkernel is told of the light
    vkernel -q --angle-deg 50 "$@" |
        vforward -q --reflectance cc24:orange --illuminant daylight:5400 --exposure 0.7 --noise-sd 1e-3 --photon-noise 1e-2 \
            --render photo.tif --render-size 320x240 | tail -1 >rendered.json
}
judge() { # the photograph, and what it is said to show
    vkernel --angle-deg 50 | vextract "$1" --exact-corners --camera canon-5d-mark-ii --illuminant D55 --regions rendered.json -q 2>/dev/null |
        vestimate -q >estimate.ndjson
    python3 - "$2" <<'END'
import json, sys
estimate = json.loads(open("estimate.ndjson").readlines()[-1])["estimate"]
verdict = estimate["verdict"]
print(verdict["level"] == "good", sys.argv[1] in verdict["because"])
END
    vscore estimate.ndjson --truth cc24:orange --table | below RMSE=0.06 CIEDE2000=4 PD=0.02 | tail -n 1
}
photo --tilt-deg 1
judge photo.tif "cannot confirm the light"
oiiotool photo.tif --pattern constant:color=1,1,1 320x240 3 --fill:color=0.5,0.5,0.5 60x70+80+20 --mul -d uint16 -o shadow.tif
judge shadow.tif "a shadow lies on panel 0"
photo --light point:0,0,5.4
judge photo.tif "a lamp 5 panel depths away"
photo --light point:0,-2,5.4
judge photo.tif "light falls off along the crease"
# A sky that was stated is an expectation: what the photograph shows is found along with it.
photo --sky only --sky-type overcast --zenith 0,0.7,0.7
for sky in only 'only --sky-type overcast' 'only --sky-type overcast --zenith 0,0.7,0.7'; do
    vkernel -q --angle-deg 50 --sky $sky |
        vextract photo.tif --camera canon-5d-mark-ii --illuminant D55 --regions rendered.json -q 2>/dev/null | vestimate -q |
        tail -n 1 | python3 -c 'import json, sys
estimate = json.load(sys.stdin)["estimate"]
day, elevation = estimate["day"], estimate["fit"].get("elevation_deg", {"value": 0, "sd": 0})
print(day["kind"], day["probability"] > 0.9, elevation["sd"] < 6)'
done
# A lamp that was stated for daylight: daylight is named.
vkernel -q --angle-deg 50 --tilt-deg 1 --sky 0.1 |
    vforward -q --reflectance cc24:neutral-5 --illuminant daylight:5400 --sky-illuminant daylight:10000 --exposure 0.7 --noise-sd 1e-3 \
        --photon-noise 1e-2 --render photo.tif --render-size 320x240 | tail -1 >rendered.json
vkernel --angle-deg 50 | vextract photo.tif --exact-corners --camera canon-5d-mark-ii --illuminant A --regions rendered.json -q |
    vestimate -q | tail -n 1 | python3 -c 'import json, sys
verdict = json.load(sys.stdin)["estimate"]["verdict"]
print(verdict["level"], verdict["because"][:50])'
