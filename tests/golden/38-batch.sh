# Many photographs in parallel: records in the order of the command line, the same for any number of threads; one that is no
# picture is a record with an error.
vkernel --angle-deg 45 --facets 2x2 --no-history -o scene.json
vforward scene.json --reflectance cc24:orange --exposure 0.5 --render fold.exr >/dev/null 2> corners
for k in 1 2 3 4 5 6 7 8 9; do oiiotool fold.exr --mulc 0.$k -d uint16 -o $k.tif; done
echo no picture > bad.tif
eval "batch() { vextract 1.tif 2.tif 3.tif bad.tif 4.tif 5.tif 6.tif 7.tif 8.tif 9.tif --scene scene.json --no-history \
    --camera canon-5d-mark-ii --illuminant D65 $(grep -o -- '--panel0.*"' corners) \"\$@\"; }"
for threads in 1 2 3; do
    status=0
    batch -j $threads --progress always -o $threads.ndjson 2> progress || status=$?
    echo "exit status $status"
    tr '\r' '\n' < progress | tail -n 2
done
cmp 1.ndjson 2.ndjson
cmp 1.ndjson 3.ndjson
grep -o '"id":"[^"]*"\|"error":"[^"]*"' 2.ndjson
