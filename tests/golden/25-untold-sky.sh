# An ideal fold is photographed under a sky that is alike in all directions, which nobody tells: its share of the light is found, and the spectrum
# with it. A fold that the sky lights alone is one as well, if that is told.
photo() { # the sky, its colour, and what is told of it
    sky=$1 colour=$2
    shift 2
    vkernel --angle-deg 50 --facets 6x6 --sky "$sky" |
        vforward --reflectance cc24:orange-yellow --sky-illuminant "$colour" --render photo.exr --render-size 320x240 2>/dev/null |
        tail -1 >rendered.json
    oiiotool photo.exr --noise:type=gaussian:stddev=0.004:seed=7 -d uint16 -o photo.tif
    vkernel --angle-deg 50 --facets 6x6 "$@" |
        vextract photo.tif --camera canon-5d-mark-ii --illuminant D65 --regions rendered.json |
        vestimate -q >estimate.ndjson
    python3 - "$sky" <<'END'
import json, sys
fit = json.loads(open("estimate.ndjson").readlines()[-1])["estimate"]["fit"]
sky, found = sys.argv[1], fit.get("even_sky", {}).get("value")
print(sky, "told" if found is None else "found" if abs(found / float(sky) - 1) < 0.1 else f"found as {found}")
END
    vscore estimate.ndjson --truth cc24:orange-yellow --table | below RMSE=0.04 CIEDE2000=1.5 PD=0.01
}
photo 0.3 daylight:9000
photo 1 D65
photo 3 D65
photo only D65 --sky only
