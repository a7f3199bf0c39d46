# A picture in unknown light: the sun 5 degrees off the bisecting plane, a blue sky, the angle and the exposure not quite known.
vkernel --angle-deg 46 --tilt-deg 5 --sky 0.18 |
    vforward --reflectance cc24:orange --sky-illuminant daylight:12000 --exposure 0.8 --noise-sd 1e-3 | tail -n +2 > sample.ndjson
vkernel | vforward --reflectance 0.5 | head -n 1 | cat - sample.ndjson > believed.ndjson
for fit in exposure exposure,tilt exposure,tilt,sky exposure,tilt,sky,angle; do
    vestimate -q believed.ndjson --fit $fit | vscore --table | below RMSE=0.04 CIEDE2000=1 PD=0.005
done
