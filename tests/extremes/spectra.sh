# Cameras of one channel, of twelve and of forty, a light of one line, one that is dark and has a gap.
table() { { echo wavelength,$1; for nm in $(seq 380 5 780); do echo $nm,$(eval "$2"); done; } > $1.csv; }
table grey 'echo 1'
table line 'echo $((nm == 550))'
table gap '[ $nm -gt 480 ] && [ $nm -lt 600 ] && echo 0 || echo 1e-200'
comb() {
    awk -v channels=$2 'BEGIN {
        printf "wavelength"
        for (n = 1; n <= channels; n++) printf ",%d", n
        for (nm = 380; nm <= 780; nm += 5) {
            printf "\n%d", nm
            for (n = 1; n <= channels; n++) printf ",%d", nm / 5 % (channels + 1) == n ? 9 : 1
        }
        print ""
    }' > $1.csv
}
comb twelve 12
comb forty 40
