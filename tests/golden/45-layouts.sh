# One picture as files may lay it out: in strips or tiles, colour after colour, compressed, with a window of data beyond the one that is
# shown, with alpha. Facet means are the same to the last digit.
vkernel --angle-deg 50 --facets 2x2 -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 2 --render photo.exr -o sample.ndjson 2>/dev/null
measure() {
    vextract -q $1 --scene scene.json --camera canon-5d-mark-ii --illuminant D65 --panel0 "358.28,441.60 346.13,100.03 155.42,55.00 166.27,426.90" \
        --panel1 "358.28,441.60 346.13,100.03 469.63,38.40 484.58,413.42" --save facet_rgb=$1.npy >/dev/null
}
oiiotool photo.exr -d uint16 --scanline --compression none -o whole.tif
oiiotool photo.exr -d uint16 --compression lzw -o lzw.tif
oiiotool photo.exr -d uint16 --compression zip --tile 64 64 -o tiles.tif
oiiotool photo.exr -d uint16 --scanline --planarconfig separate -o planes.tif
oiiotool photo.exr --ch R,G,B,A=1 -d uint16 -o alpha.tif
oiiotool photo.exr -d float --scanline --compression none -o whole.exr
oiiotool photo.exr -d float --compression piz -o piz.exr
oiiotool photo.exr -d float --tile 64 64 -o tiles.exr
oiiotool photo.exr --ch R,G,B,A=1 -d float -o alpha.exr
oiiotool photo.exr --create 700x600 3 --addc 9 --paste +20+30 --origin -20-30 --fullsize 640x480+0+0 -d float -o window.exr
for kind in tif exr; do
    for photo in whole *.$kind; do
        photo=${photo%.$kind}.$kind
        [ $photo = photo.exr ] || measure $photo
    done
    for photo in *.$kind; do
        case $photo in
            photo.exr | whole.$kind) ;;
            *) cmp $photo.npy whole.$kind.npy && echo $photo is read as whole.$kind ;;
        esac
    done
done
