# Dust, hot pixels and a hair that oiiotool drops on a noisy photograph: facets stay, what was left out is counted, and the overlay
# shows it in red.
vkernel --angle-deg 50 --facets 5x5 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 2 --render photo.exr -o sample.ndjson 2>/dev/null
oiiotool photo.exr --noise:type=gaussian:stddev=0.002:seed=3 -d half -o clean.exr
oiiotool clean.exr --fill:color=0.02,0.02,0.02 4x4+250+200 --fill:color=0.01,0.03,0.02 6x3+400+300 \
    --fill:color=9,9,9 1x1+200+150 --fill:color=9,0.2,0.1 1x1+420+200 --line:color=0.05,0.05,0.05 220,330,300,380 -d half -o dusty.exr
for photo in clean dusty; do
    vextract $photo.exr --exact-corners --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --panel0 "358.28,441.60 346.13,100.03 155.42,55.00 166.27,426.90" \
        --panel1 "358.28,441.60 346.13,100.03 469.63,38.40 484.58,413.42" --save facet_rgb=$photo.npy --save facet_sd=sd.npy \
        --save facet_outliers=$photo-out.npy --overlay $photo.png > $photo.json
done
oiiotool dusty.png -o dusty.ppm
python3 - <<'END'
import numpy as np
clean, dusty, sd = (np.load(name) for name in ("clean.npy", "dusty.npy", "sd.npy"))
shift = np.abs(dusty / clean - 1).max()
print("facets within 0.1%" if shift < 1e-3 else f"facets moved by {shift:.2%}")
print("and within a standard error" if (np.abs(dusty - clean) < sd).all() else "and beyond a standard error")
print("left out:", int(np.load("clean-out.npy").sum()), "and", int(np.load("dusty-out.npy").sum()), "pixels")
data = open("dusty.ppm", "rb").read()
head, pixels = data[:16], np.frombuffer(data[16:], "u1").reshape(960, 1280, 3).astype(int)
print(head.split(), "with red:", bool((pixels[401:407, 501:507, 0] - pixels[401:407, 501:507, 1] > 150).all()))
END
