# tolerance 1e-3 2e-4
# A known coloured card in the place of a panel tells a dark sheet apart better than a second panel of the same sheet.
vkernel -o scene.json
for card in "" "--reference-panel cc24:magenta" "--panel-reflectance 0=cc24:magenta"; do
    vforward scene.json --reflectance cc24:dark-skin cc24:purple $card --noise-sd 1e-3 --seed 3 | vestimate | vscore --table
done
