# tolerance 1e-3 2e-4
# A fold under two lights, a picture each: facet_rgb is [picture][facet][channel]. And flat sheets under three, estimated as the
# paper's rivals do.
vkernel --angle-deg 60 --facets 1x1 | vforward --reflectance 0.5 --camera nikon-d5100 --illuminant D65 --illuminant A | tail -n 1
vkernel --facets 4x4 |
    vforward --reflectance cc24:red cc24:cyan --illuminant D65 --illuminant A --noise-sd 1e-3 --seed 1 |
    vestimate | vscore --table | below RMSE=0.015 CIEDE2000=0.8 PD=0.002
vkernel --angle-deg 180 --facets 1x1 |
    vforward --reflectance cc24:red cc24:cyan --illuminant LCD-R --illuminant LCD-G --illuminant LCD-B -o flat.ndjson
vestimate --method park --components 5 flat.ndjson | vscore --table
vestimate --method khan flat.ndjson | vscore --table
vestimate --method khan --exposure sum flat.ndjson | vscore --table
vkernel --facets 2x2 | vestimate --plan --illuminant D65 --illuminant A --reflectance cc24:red | below expected_rmse=0.03
