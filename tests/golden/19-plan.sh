# The angle at which to fold, before any photograph: the error to expect of the chart's patches at facet noise 1e-3.
for angle in 30 45 60 90; do
    vkernel --angle-deg $angle | vestimate --plan
done | below expected_rmse=0.08,0.04
# Does a card in the place of a panel help, the exposure and the tilt of the sun being unknown?
for card in 0.9 cc24:magenta; do
    vkernel | vestimate --plan --reference-panel $card --fit exposure,tilt
done | below expected_rmse=0.08,0.04 expected_sd=1
