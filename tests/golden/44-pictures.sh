# Previews and overlays: their sizes, what a preview tells of its photograph, and that it stands upright.
vkernel --angle-deg 50 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 2 --render photo.exr -o sample.ndjson 2>/dev/null
oiiotool photo.exr --resize 4000x3000 -d uint16 -o large.tif
oiiotool photo.exr --rotate90 --orientation 8 -d uint16 -o turned.tif
oiiotool photo.exr --ch R -d uint16 -o grey.png
for photo in photo.exr large.tif turned.tif grey.png; do
    vextract $photo --preview 'preview-{}.png'
done
vextract photo.exr large.tif --exact-corners --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --panel0 "358.28,441.60 346.13,100.03 155.42,55.00 166.27,426.90" \
    --overlay 'overlay-{}.png' > samples.ndjson
for picture in preview-*.png overlay-*.png; do
    oiiotool --info -v $picture | grep -e "$picture *:" -e 'vfold photograph size' | tr -s ' ' | sed 's/channel, uint8 png/8-bit/'
done
oiiotool --fail 0.01 --warn 0.01 --diff preview-photo.png preview-turned.png | grep PASS
