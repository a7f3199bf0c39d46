# Corners from a file: the same for every photograph, or each photograph's own, found in previews of another size.
vkernel --angle-deg 45 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 0.5 --render fold.exr >/dev/null 2> corners
eval "set -- $(grep -o -- '--panel0.*"' corners)"
photo() { vextract "$@" --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --no-history --save facet_rgb=got.npy; }
photo fold.exr --panel0 "$2" --panel1 "$4" >/dev/null
cp got.npy flags.npy
json() { echo "$1" | sed 's/ /],[/g; s/.*/[[&]]/'; }
same() { python3 -c "import numpy as np; print('$1:', 'as by flags' if np.array_equal(*map(np.load, ('got.npy', 'flags.npy'))) else 'other')"; }

echo "{\"panel0\": $(json "$2"), \"panel1\": $(json "$4"), \"image\": \"fold.exr\", \"width\": 640, \"height\": 480}" > all.json
photo fold.exr --regions all.json >/dev/null
same "one for all"

# the picker works on a preview of half the size
python3 - <<'END'
import json
regions = json.load(open("all.json"))
half = {k: [[x / 2, y / 2] for x, y in regions[k]] for k in ("panel0", "panel1")}
entry = {**half, "image": "fold", "width": 320, "height": 240, "chart": None}
other = {"image": "squeezed.exr", "panel0": [[1, 1], [9, 1], [9, 9], [1, 9]], "width": 640, "height": 480}
json.dump([other, entry], open("list.json", "w"))
END
photo fold.exr --regions list.json >/dev/null
same "each its own, from a preview"

echo "{\"panel0\": [[1,1],[9,1],[9,9],[1,9]], \"panel1\": $(json "$4")}" > wrong.json
photo fold.exr --regions wrong.json --panel0 "$2" >/dev/null
same "a flag wins over the file"

oiiotool fold.exr --resize 640x400 -o squeezed.exr
cp fold.exr unknown.exr
status=0
vextract fold.exr squeezed.exr unknown.exr fold.exr --regions list.json --scene scene.json --camera canon-5d-mark-ii --illuminant D65 \
    -o batch.ndjson 2> said || status=$?
cat said
echo "exit status $status"
sed 's/.*"id":"\([^"]*\)".*\("error":.*\)/\1 \2/; s/.*"id":"\([^"]*\)".*/\1/' batch.ndjson
