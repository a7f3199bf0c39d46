# A fold in light from anywhere: a lamp and a window two panels away, an overcast sky, a clear one about a low sun. The spectrum comes back.
for light in '--light point:0.5,1,2' '--light area:-1,1,1.5,1x0.7' '--sky only --sky-type overcast --zenith 0,0.7,0.7' \
    '--sky 0.5 --sky-type clear --zenith 0,0.5,0.8 --tilt-deg 3'; do
    vkernel --facets 6x6 $light |
        vforward --reflectance cc24:red cc24:cyan --noise-sd 1e-3 --seed 1 | vestimate | vscore --table |
        below RMSE=0.03,0.03 CIEDE2000=0.5 PD=0.004 | tail -n 1
done
# What the sun and a uniform sky give is the same by either way.
vkernel --facets 4x4 --tilt-deg 6 --slant-deg 10 --sky 0.3 -o formulas.json
vkernel --facets 4x4 --light 0.1029393,0.1736482,0.9793993 --sky 0.3 --tolerance 2e-3 -o sources.json
for scene in formulas sources; do vforward $scene.json --reflectance cc24:white -o $scene.ndjson; done
python3 - <<'END'
import json
rgb = [[json.loads(line) for line in open(f"{way}.ndjson")][-1]["facet_rgb"] for way in ("formulas", "sources")]
ratios = [b / a for one, other in zip(*rgb) for a, b in zip(one, other)]
print(len(ratios), "values within 0.2 %:", all(abs(ratio - 1) < 2e-3 for ratio in ratios))
END
# A fold of a lamp has panels as any other: a card in the place of one.
vkernel --facets 4x4 --light point:0,1,2 | vforward --reflectance cc24:red --material 'panel 1=cc24:white' | vestimate | vscore --table |
    below RMSE=0.01 CIEDE2000=0.3 PD=0.002 | tail -n 1
