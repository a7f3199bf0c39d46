# The sun leans over panel 1 and lights panel 0 more; a fifth of the light is sky, bluer than the sun.
vkernel --angle-deg 55 --facets 2x2 --tilt-deg 6 --sky 0.25 --no-history |
    vforward --reflectance cc24:orange-yellow --camera nikon-d5100 --sky-illuminant daylight:8000 \
        --wavelengths-nm 400:700:20 --no-history |
    grep '"kind":"sample"'
