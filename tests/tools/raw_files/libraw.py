"""What LibRaw reads of a RAW file, as JSON: libraw.py FILE COLUMN ROW [X,Y]...

COLUMN and ROW are where a picture begins on the sensor, X,Y places of the picture. Printed are where LibRaw has it begin and end, its filters from
there on, its levels, and the mean of each colour in the nine sites around every place.
"""
import json
import sys

import numpy as np
import rawpy

path, column, row, *places = sys.argv[1:]
column, row = int(column), int(row)
with rawpy.imread(path) as raw:
    letters = raw.color_desc.decode()
    number = lambda k: "RGB".index(letters[k])
    colour = np.vectorize(number)(raw.raw_colors[row:, column:])
    sites = raw.raw_image[row:, column:].astype(float)
    sizes, filters = raw.sizes, raw.raw_pattern.shape
    black = [[], [], []]
    for k, level in enumerate(raw.black_level_per_channel):
        black[number(k)].append(level)
    values = []
    for place in places:
        x, y = map(int, place.split(","))
        of, light = colour[y - 1 : y + 2, x - 1 : x + 2], sites[y - 1 : y + 2, x - 1 : x + 2]
        values.append([float(light[of == k].mean()) for k in range(3)])
    print(
        json.dumps(
            {
                "visible": [sizes.left_margin, sizes.top_margin, sizes.width, sizes.height],
                "mosaic": "".join("RGB"[k] for k in colour[: filters[0], : filters[1]].ravel()),
                "black": [float(np.mean(levels)) for levels in black],
                "white": raw.white_level,
                "values": values,
            }
        )
    )
