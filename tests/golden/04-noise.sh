# Noise is the same on every machine: a seed, and a stream of it a sample.
vkernel --facets 2x2 --no-history |
    vforward --reflectance cc24:red cc24:cyan --noise-sd 1e-3 --photon-noise 5e-3 --seed 7 \
        --wavelengths-nm 400:700:20 --no-history |
    grep '"kind":"sample"'
