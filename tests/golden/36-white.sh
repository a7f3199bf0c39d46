# tolerance 1e-3 1e-3
# Uneven light is undone with a photograph of a white sheet, and a white card in the picture says what the numbers are worth.
vkernel --angle-deg 45 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 0.5 --render fold.exr -o truth.ndjson 2> corners
eval "panels() { vextract \"\$@\" --scene scene.json --camera canon-5d-mark-ii --illuminant D65 $(grep -o -- '--panel0.*"' corners) --save facet_rgb=got.npy; }"
compare() {
    python3 - "$@" <<'END'
import json, sys
import numpy as np
name, exposure = sys.argv[1], float(sys.argv[2])
truth = np.array(json.loads(open("truth.ndjson").readlines()[1])["facet_rgb"]) / 0.5
error = np.abs(np.load("got.npy")[0] / exposure / truth - 1).max()
print(f"{name}: {'right' if error < 2e-3 else f'off by {error:.2%}'}")
END
}

# light that falls off by half to the right and is warm
oiiotool --pattern fill:topleft=0.9,0.8,0.7:topright=0.45,0.4,0.35:bottomleft=0.8,0.7,0.6:bottomright=0.4,0.35,0.3 640x480 3 -o sheet.exr
mean="0.6375,0.5625,0.4875" # a flat field's own mean counts as 1
oiiotool fold.exr sheet.exr --mul -o uneven.exr
panels uneven.exr --white sheet.exr >/dev/null
python3 -c "import numpy as np; np.save('got.npy', np.load('got.npy') / [$mean])"
compare "flat field" 0.5
oiiotool sheet.exr -d uint16 -o sheet.tif
oiiotool uneven.exr -d uint16 -o uneven.tif
panels uneven.tif --white sheet.tif >/dev/null
python3 -c "import numpy as np; np.save('got.npy', np.load('got.npy') / [$mean])"
compare "flat field of 16 bits" 0.5

# a camera that looks down may note any orientation: pixels of one place of the sensor belong together
for orientation in 3 6; do
    oiiotool sheet.tif --orientation $orientation -d uint16 -o turned.tif
    panels uneven.tif --white turned.tif 2>&1 >/dev/null
    python3 -c "import numpy as np; np.save('got.npy', np.load('got.npy') / [$mean])"
    compare "flat field of orientation $orientation" 0.5
done

# a white card of reflectance 0.9 that the sun meets at 60 degrees; white in this light is 1 in green, less in red and blue
set -- $(vkernel --angle-deg 180 --facets 1x1 | vforward --reflectance 0.45 --save facet_rgb=white.npy >/dev/null
    python3 -c "import numpy as np; print(*(0.5 * np.load('white.npy')[0, 0]))")
oiiotool fold.exr --fill:color=$1,$2,$3 60x40+10+10 --mulc 0.6,0.8,0.9 -o card.exr
panels card.exr --white-region "10,10 70,10 70,50 10,50" --white-reflectance 0.9 --white-cos 0.5 -o sample.ndjson
exposure=$(grep -o '"exposure":[0-9.]*' sample.ndjson | tail -n 1)
echo "{$exposure}"
compare "white card" ${exposure#*:}

# printing paper of unknown whiteness, brightened: its green channel alone shows the exposure, and no channel is balanced by it
set -- $(python3 -c "import numpy as np; r, g, b = 0.5 * np.load('white.npy')[0, 0] / 0.45; print(0.87 * r, 0.9 * g, 1.1 * b)")
oiiotool fold.exr --fill:color=$1,$2,$3 60x40+10+10 -o paper.exr
panels paper.exr --white-region "10,10 70,10 70,50 10,50" -o sample.ndjson 2>&1
compare "facets beside white paper" 0.5
python3 - <<'END'
import json
sample = json.loads(open("sample.ndjson").readlines()[1])
paper = sample["white_paper"]
off = paper["exposure"] / 0.5 - 1
print(f"white paper: exposure {'right' if abs(off) < 0.05 else f'off by {off:.1%}'} ± {paper['exposure_sd'] / paper['exposure']:.1%}", "calibration" in sample)
END
vestimate sample.ndjson 2>/dev/null | python3 -c "
import json, sys
exposure = json.loads(sys.stdin.readlines()[1])['estimate']['exposure']
print('estimated exposure', 'right' if abs(exposure / 0.5 - 1) < 0.03 else exposure)"
vestimate --fit exposure sample.ndjson 2>&1 >/dev/null | grep 'white paper'

# a picture of paper alone, in the uneven light, shows the exposure of a photograph with half its exposure time, where both record their settings
oiiotool sheet.exr --mulc $1,$2,$3 -d uint16 -o of_paper.tif
oiiotool uneven.exr --mulc 0.5 -d uint16 -o unknown.tif
python3 - <<'END'
import struct

def with_settings(tiff, exposure_s):  # a first directory at the end of a little-endian TIFF, with EXIF: f/8, ISO 100
    tiff += bytes(len(tiff) % 2)
    (at,) = struct.unpack_from("<I", tiff, 4)
    (count,) = struct.unpack_from("<H", tiff, at)
    entry = lambda tag, kind, value: struct.pack("<HHII", tag, kind, 1, value)
    exif_at = len(tiff) + 16
    ratios = struct.pack("<4I", round(1e6 * exposure_s), 10**6, 8, 1)
    exif = struct.pack("<H", 3) + entry(33434, 5, exif_at - 16) + entry(33437, 5, exif_at - 8) + entry(34855, 3, 100) + bytes(4)
    entries = [tiff[at + 2 + 12 * n :][:12] for n in range(count)] + [entry(34665, 4, exif_at)]
    entries.sort(key=lambda entry: struct.unpack_from("<H", entry))
    return tiff[:4] + struct.pack("<I", exif_at + len(exif)) + tiff[8:] + ratios + exif + struct.pack("<H", len(entries)) + b"".join(entries) + bytes(4)

for source, name, exposure_s in (("unknown", "half", 0.005), ("of_paper", "of_paper", 0.01)):
    tiff = open(source + ".tif", "rb").read()
    open(name + ".tif", "wb").write(with_settings(tiff, exposure_s))
END
for photo in half unknown; do panels $photo.tif --white of_paper.tif -o $photo.ndjson 2>&1; done
panels half.tif --white of_paper.tif --white-reflectance 0.9 --white-cos 0.8 -o card.ndjson 2>&1
python3 - <<'END'
import json
for name, true in (("half", 0.25 * 0.5625), ("card", 0.25 * 0.5625 / 0.8), ("unknown", None)):
    paper = json.loads(open(name + ".ndjson").readlines()[1]).get("white_paper")
    if true and paper:
        print(name, "right" if abs(paper["exposure"] / true - 1) < 0.05 else paper["exposure"] / true, paper["image"])
    else:
        print(name, paper)
END

echo what is refused
oiiotool sheet.exr --resize 320x240 -o small.exr
oiiotool sheet.exr --mulc 3 -d uint16 -o clipped.tif
oiiotool sheet.exr --mulc 0 -o dark.exr
oiiotool sheet.exr --colorconvert linear sRGB -d uint8 -o camera.jpg
for sheet in small.exr clipped.tif dark.exr camera.jpg; do panels uneven.exr --white $sheet 2>&1 || echo "exit status $?"; done
panels uneven.exr --white-region "10,10 70,10 70,50 10,50" --white sheet.exr 2>&1 || echo "exit status $?"
