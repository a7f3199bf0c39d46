# tolerance 1e-3 2e-4
# A whole experiment: six colours measured in daylight, noise-free and with the noise of a good photograph.
vkernel --angle-deg 45 -o scene.json
for noise in 0 1e-3; do
    echo "noise $noise"
    vforward scene.json --reflectance cc24:blue cc24:green cc24:red cc24:yellow cc24:magenta cc24:cyan \
        --noise-sd $noise --seed 1 | vestimate | vscore --table
done
