# A sheet folded three times, in sun and sky: spectra from its facets. Then one folded so often that a dull sky, its only light, is sampled, and says so.
vkernel --angle-deg 60 --folds 3 --facets 4x4 --light 0.2,0,1 --sky 0.2 --tolerance 0.02 |
    vforward --reflectance cc24:red cc24:cyan --sky-illuminant daylight:9000 --noise-sd 1e-3 --seed 1 | vestimate | vscore --table |
    below RMSE=0.03,0.02 CIEDE2000=0.5 PD=0.002
vkernel --angle-deg 60 --folds 8 --facets 2x2 --mesh facets --light none --sky 1 --sky-type overcast --no-history -o dull.json 2> said.txt
sed 's/up to .*/up to .../' said.txt
vforward dull.json --reflectance cc24:red --illuminant D65 --sky-illuminant daylight:6500 | vestimate | vscore --table |
    below RMSE=0.01 CIEDE2000=0.3 PD=0.001
