# A photograph whose frame cuts a panel: facets that reach out of it are null, the others stay what they were; a panel wholly
# outside is an error.
vkernel --angle-deg 50 --facets 5x5 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 2 --render photo.exr -o sample.ndjson 2>/dev/null
oiiotool photo.exr --cut 340x340+260+0 -d half -o cut.exr
panels() { # corners of both panels, moved to the left
    awk -v dx=$1 'BEGIN {
        crease = sprintf("%.2f,441.60 %.2f,100.03", 358.28 - dx, 346.13 - dx)
        printf "--panel0\n%s %.2f,55.00 %.2f,426.90\n", crease, 155.42 - dx, 166.27 - dx
        printf "--panel1\n%s %.2f,38.40 %.2f,413.42\n", crease, 469.63 - dx, 484.58 - dx
    }'
}
extract() { panels $2 | tr '\n' '\0' | xargs -0 vextract --exact-corners $1 --scene scene.json --camera canon-5d-mark-ii --illuminant D65; }
extract photo.exr 0 | tail -1 > whole.json
extract cut.exr 260 | tail -1 > part.json
python3 - <<'END'
import json
import numpy as np
whole, part = (json.load(open(name))["facet_rgb"] for name in ("whole.json", "part.json"))
for panel in (0, 1):
    print(f"panel {panel}, one line per row from the crease, one letter per facet from end 0")
    for row in range(5):
        facets = [25 * panel + 5 * row + col for col in range(5)]
        print("".join("-" if part[k] is None else "=" if np.allclose(part[k], whole[k], rtol=2e-3) else "?" for k in facets))
END
extract cut.exr 900 2>&1 >/dev/null | grep -o 'panel 0: no facet lies in the picture of 340 x 340 px'
