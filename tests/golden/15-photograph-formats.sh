# One rendered photograph as other programs may hand it on: facet means agree with the OpenEXR's, and pixels that hold
# no light are left out and counted.
vkernel --angle-deg 50 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 2 --render photo.exr -o sample.ndjson 2> corners
crease="358.28,441.60 346.13,100.03"
grep -c -- "--panel0 \"$crease 155.42,55.00 166.27,426.90\" --panel1 \"$crease 469.63,38.40 484.58,413.42\"" corners

oiiotool photo.exr -d uint16 -o linear.tif
oiiotool photo.exr -d uint16 -o linear.png
oiiotool photo.exr --colorconvert linear sRGB -d uint8 -o srgb.png
oiiotool photo.exr --colorconvert linear sRGB -d uint8 --compression jpeg:98 -o srgb.jpg
oiiotool photo.exr --rotate90 --orientation 8 -d uint16 -o turned.tif
oiiotool photo.exr --cut 400x440+120+20 -d uint16 -o cropped.tif
oiiotool photo.exr --fill:color=9,9,9 10x8+200+150 -d uint16 -o clipped.tif
oiiotool --create 10x8 3 --addc -1 --powc 0.5 photo.exr --paste +200+150 -o nan.exr

for photo in photo.exr linear.tif linear.png srgb.png srgb.jpg turned.tif cropped.tif clipped.tif nan.exr; do
    case $photo in
        cropped.tif) dx=120 dy=20 ;; # the corners move with the picture's origin
        *) dx=0 dy=0 ;;
    esac
    corners() { echo "$@" | tr ' ' '\n' | awk -F, -v dx=$dx -v dy=$dy '{ printf "%s%.2f,%.2f", s, $1 - dx, $2 - dy; s = " " }'; }
    vextract -q $photo --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --panel0 "$(corners $crease 155.42,55.00 166.27,426.90)" \
        --panel1 "$(corners $crease 469.63,38.40 484.58,413.42)" --save facet_rgb=$photo.npy \
        --save facet_clipped=clipped.npy --save facet_not_finite=nan.npy >/dev/null
    python3 - $photo <<'END'
import sys
import numpy as np
photo, limit = sys.argv[1], {".jpg": 3e-3}.get(sys.argv[1][-4:], 1e-3)
reference = np.load("photo.exr.npy")
error = np.abs(np.load(photo + ".npy") / reference - 1)[..., 0].max()
counts = [int(np.load(name).sum()) for name in ("clipped.npy", "nan.npy")]
print(f"{photo}: red within {limit:.1%}" if error < limit else f"{photo}: red off by {error:.2%}", end="; ")
print("{} clipped, {} not finite".format(*counts))
END
done
