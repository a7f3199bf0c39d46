# A whole experiment: six colours measured in daylight, noise-free and with the noise of a good photograph.
vkernel --angle-deg 45 -o scene.json
experiment() {
    vforward scene.json --reflectance cc24:blue cc24:green cc24:red cc24:yellow cc24:magenta cc24:cyan \
        --noise-sd $1 --seed 1 | vestimate | vscore --table
}
echo "noise 0"
experiment 0 | below RMSE=0.01,0.005 CIEDE2000=0.05 PD=0.001
echo "noise 1e-3"
experiment 1e-3 | below RMSE=0.12,0.03 CIEDE2000=1,0.4 PD=0.15,0.03
