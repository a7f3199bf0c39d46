# A known coloured card in the place of a panel tells a dark sheet apart better than a second panel of the same sheet.
vkernel -o scene.json
with() {
    vforward scene.json --reflectance cc24:dark-skin cc24:purple "$@" --noise-sd 1e-3 --seed 3 | vestimate | vscore --table
}
with | below RMSE=0.05,0.03 CIEDE2000=0.8 PD=0.03
with --reference-panel cc24:magenta | below RMSE=0.017,0.014 CIEDE2000=0.4 PD=0.005
with --panel-reflectance 0=cc24:magenta | below RMSE=0.035,0.025 CIEDE2000=0.6 PD=0.02
