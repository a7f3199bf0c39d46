# Leaves streams with every kind of record, and every form of their fields, that the five tools write.
data=$CARGO_MANIFEST_DIR/tests/data

# folds: even and graded rows, unlike panels, sampled form factors, an angle by its corners, a card, several pictures, noise, few bounces
vkernel --angle-deg 50 --facets 3x3 -o scene.ndjson
vkernel --angle-deg 60 --facets 2x3 --spacing graded --panel1-depth 0.7 --tilt-deg 4 --sky 0.2 -o unlike.ndjson
vkernel --angle-deg 60 --facets 2x2 --method monte-carlo --sampling cosine --samples 1000 -q -o sampled.ndjson
vextract --find "$data/photos/a_ideal_magenta_50.exr" | vkernel --regions - --facets 2x2 -o opened.ndjson
vforward unlike.ndjson --reflectance cc24:red --reference-panel cc24:yellow --sky-illuminant daylight:9000 --camera sigma-sd-merrill \
    --wavelengths-nm 400:680:4 -o card.ndjson
vforward sampled.ndjson --reflectance 0.5 --bounces 2 --wavelengths-nm 380:780:20 -o few.ndjson
vforward scene.ndjson --reflectance cc24:red 0.5 --illuminant D65 --illuminant A --noise-sd 1e-3 -o pictures.ndjson
vestimate pictures.ndjson --save covariance=covariance.npy --trace trace.ndjson -o estimates.ndjson
vestimate card.ndjson --noise-sd 1e-3 -o card-estimate.ndjson
vforward scene.ndjson --reflectance cc24:red --noise-sd 1e-3 |
    vestimate --fit exposure,tilt,sky,angle -q -o fitted.ndjson
vforward scene.ndjson --reflectance cc24:red | vestimate --prior smooth -o smooth.ndjson
vforward scene.ndjson --reflectance cc24:red --illuminant A --noise-sd 1e-2 | vestimate --illuminant unknown -q -o unknown-light.ndjson
vestimate scene.ndjson --plan --reflectance cc24:red --fit exposure,tilt,sky,angle,daylight -q -o plan.ndjson
vkernel --facets 4x1 -o other.json
cat other.json other.json | vestimate --plan --join --reflectance cc24:red -q -o joined_plan.ndjson
vscore estimates.ndjson --colour --illuminant D65 --illuminant A --metrics rmse,ciede2000,pd,gfc,angle,metamerism --by id -o scored.ndjson
vscore fitted.ndjson --colour -o scored-fitted.ndjson

# flat sheets
vkernel --angle-deg 180 --facets 1x1 | vforward --reflectance cc24:red cc24:blue -o flat.ndjson
vestimate flat.ndjson --method park | vscore -o park.ndjson
vestimate flat.ndjson --method khan | vscore -o khan.ndjson

# shapes in all lights, a group of which is known; a kernel made elsewhere
vkernel --facets 2x2 --mesh facets --light area:0,1,2,1x1 --light 0,0,1 --sky 0.2 --sky-type 12 -q -o lamps.ndjson
vkernel --shape "$data/shapes/corner.obj" --two-sided --mesh facets --light 1,1,2 --light point:1,1,2 --sky 0.2 --sky-type overcast \
    -q -o corner.ndjson
vkernel --folds 2 --angle-deg 80 --facets 2x2 --mesh facets --light 0,0,1 --sky 0.1 --save kernel=K.npy -o accordion.ndjson
group=$(sed 's/.*"groups":\[{"name":"\([^"]*\)".*/\1/' corner.ndjson)
vforward corner.ndjson --reflectance cc24:red --material "$group=cc24:white" | vestimate -q | vscore -o corner-scored.ndjson
vforward --kernel K.npy --reflectance 0.5 -o elsewhere.ndjson

# photographs: rendered, with a white card and corners that are off; one that is no picture among them
vforward scene.ndjson --reflectance cc24:orange --exposure 0.5 --render fold.exr -o rendered.ndjson 2>corners
eval "set -- $(grep -o -- '--panel0.*"' corners)"
oiiotool fold.exr --fill:color=0.45,0.45,0.45 60x40+10+10 --attrib Make vfold -d uint16 -o card.tif
vforward scene.ndjson --reflectance cc24:orange --specular-weight 0.8 --specular-roughness 0.4 --render glossy.exr -o glossy.ndjson 2>said
vextract glossy.exr --regions glossy.ndjson --scene scene.ndjson --camera canon-5d-mark-ii -q -o one.ndjson
vestimate one.ndjson -q -o found.ndjson
cp glossy.exr again.exr
vextract again.exr --regions glossy.ndjson --scene scene.ndjson --camera canon-5d-mark-ii -q -o other.ndjson
cat one.ndjson other.ndjson | vestimate -q --join=glossy,again -o joined.ndjson
echo no picture > bad.tif
vextract card.tif bad.tif --scene scene.ndjson --camera canon-5d-mark-ii "$@" --white-region "10,10 70,10 70,50 10,50" \
    --distortion 0,0 --refine -q -o photographs.ndjson 2>said || [ $? = 3 ]
vextract card.tif --regions rendered.ndjson --scene scene.ndjson --camera canon-5d-mark-ii -q --resume resumed.ndjson
# nobody measured this camera: another stands in, which is said
oiiotool card.tif --attrib Model unknown -o unknown.tif
vextract unknown.tif "$@" --scene scene.ndjson -q -o stood-in.ndjson 2>said
echo '{"white_balance_gains": [2, 1, 1.5], "camera_to_linear_srgb": [[1.6, -0.5, -0.1], [-0.2, 1.5, -0.3], [0, -0.5, 1.5]]}' > camera.json
vextract "$data/photos/f_srgb_blue_flower_50.jpg" --regions rendered.ndjson --undo camera.json --scene scene.ndjson \
    --camera nikon-d5100 -q -o developed.ndjson
# black that was not subtracted, numbers that end below white, and a matrix, as pixels tell; panels of which half is marked
vkernel --angle-deg 45 --facets 4x4 -o finer.ndjson
vforward finer.ndjson -q --reflectance cc24:white --photon-noise 0.02 --render-size 480x360 --render noisy.tif | tail -n 1 > marked.json
oiiotool noisy.tif --mulc 0.98 --addc 0.02 -d uint16 -o black.tif
oiiotool noisy.tif --clamp:max=0.8 -d uint16 -o cut.tif
oiiotool noisy.tif --ccmatrix 1.9,-0.2,0.05,-0.8,1.9,-0.75,-0.1,-0.7,1.7 -d uint16 -o matrix.tif
vextract black.tif cut.tif matrix.tif --scene finer.ndjson --regions marked.json --camera canon-5d-mark-ii --illuminant D65 -q \
    -o levels.ndjson 2>said || [ $? = 3 ]
# a photograph in which the fold is found
vextract "$data/photos/a_ideal_magenta_50.exr" --scene finer.ndjson --camera canon-5d-mark-ii --illuminant D65 -q -o found.ndjson
# the same, the scene being another fold
vkernel --angle-deg 75 --facets 2x2 |
    vextract "$data/photos/a_ideal_magenta_50.exr" --camera canon-5d-mark-ii --illuminant D65 -q -o otherwise.ndjson
# one whose camera says how it was set
vextract "$data/photos/h_raw_magenta_50.dng" --scene finer.ndjson --camera canon-5d-mark-ii --illuminant D65 -q -o set.ndjson
# nobody measured this camera either: its curves are predicted from the colour matrix of the file
LC_ALL=C sed 's/EOS 5D Mark II/EOS 9X Mark II/' "$data/photos/h_raw_magenta_50.dng" > unmeasured.dng
vextract unmeasured.dng --scene finer.ndjson --illuminant D65 -q -o predicted.ndjson 2>said
# one beside which a chart is found
vkernel --angle-deg 180 --facets 1x1 | vforward --reflectance cc24 --camera canon-5d-mark-ii --illuminant D65 -q -o patches.ndjson
fills=$(sed 1d patches.ndjson | python3 -c '
import json, sys
for k, line in enumerate(sys.stdin):
    rgb = json.loads(line)["facet_rgb"][0]
    print("--fill:color=%.6f,%.6f,%.6f 18x18+%d+%d" % (*rgb, 508 + 21 * (k % 6), 200 + 21 * (k // 6)))')
oiiotool "$data/photos/a_ideal_magenta_50.exr" $fills -o beside.exr
vextract beside.exr --scene finer.ndjson --camera canon-5d-mark-ii --illuminant D65 -q -o beside.ndjson
# in the light of a sky, of which nobody says anything: an ideal fold, and a glossy one in haze
under_sky() { # sky, exposure, sheet
    vkernel --angle-deg 60 --sky $1 |
        vforward --reflectance cc24:foliage --exposure $2 --photon-noise 0.01 $3 --render dull.tif -q -o dull.ndjson
    vkernel --angle-deg 60 | vextract dull.tif --regions dull.ndjson --camera canon-5d-mark-ii --illuminant D65 -q | vestimate -q
}
under_sky 20 0.04 '' >even-sky.ndjson
under_sky 1 0.4 '--specular-weight 0.3 --body-roughness-deg 15' >hazy.ndjson
# as the camera developed it, which leaves a doubt
vextract "$data/photos/f_srgb_blue_flower_50.jpg" --regions rendered.ndjson --scene scene.ndjson --camera nikon-d5100 --illuminant D65 -q |
    vestimate -q -o doubtful.ndjson
vestimate photographs.ndjson -q -o photographed.ndjson 2>said || [ $? = 3 ]
# a brightened sheet
printf 'nm,f\n380,0\n410,0.08\n435,0.2\n460,0.12\n500,0.03\n540,0\n780,0\n' >brightener.csv
vkernel --angle-deg 45 | vforward --reflectance cc24:white --fluorescence brightener.csv --noise-sd 1e-3 -q | vestimate -q -o brightened.ndjson
# a thin sheet, through which light from behind comes, and one that is backed
printf 'nm,f\n380,0.06\n780,0.08\n' >behind.csv
vkernel --angle-deg 45 | vforward --reflectance cc24:white --fluorescence behind.csv --noise-sd 1e-3 -q | vestimate --exposure 1 -q -o thin.ndjson
vkernel --angle-deg 45 | vforward --reflectance cc24:white --noise-sd 1e-3 -q | vestimate --exposure 1 --backed -q -o backed.ndjson
