# A photograph whose camera nobody wrote into it: one that contradicts the stated camera names others, and is not good.
photo=$CARGO_MANIFEST_DIR/tests/data/photos/a_ideal_magenta_50.exr
judge() {
    vkernel -q --angle-deg 50 |
        vextract -q $photo --exact-corners --illuminant D65 --panel0 '332.1,462.5 345.3,77.1 121.9,11.9 103.9,442.2' \
            --panel1 '332.1,462.5 345.3,77.1 484.9,16.7 472.0,453.4' "$@" | vestimate -q | tail -n 1 | python3 -c 'import json, re, sys
verdict = json.load(sys.stdin)["estimate"]["verdict"]
print(verdict["level"], *re.findall(r"times as probable as the \S+ you stated", verdict["because"]))'
}
judge --camera canon-5d-mark-ii
judge --camera nikon-d5100
