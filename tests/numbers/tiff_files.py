"""Writes TIFF files in every layout that the specification has for the same picture, one a line of standard output: name, then what it is.

Sample by sample as in TIFF 6.0 and its technical notes 1 to 3 (predictor of floats); NumPy alone is needed.
"""

import itertools
import struct
import sys
import zlib

import numpy as np

WIDTH, HEIGHT, ROWS_A_STRIP, TILE = 21, 19, 7, 16
KINDS = {"uint8": 1, "uint16": 1, "uint32": 1, "int16": 2, "float16": 3, "float32": 3, "float64": 3}
# samples a pixel: how many are grey or colours, and ExtraSamples (0 nobody knows what, 1 alpha that is multiplied in, 2 alpha)
SAMPLES = {
    "grey": (1, []),
    "grey, alpha": (1, [2]),
    "RGB": (3, []),
    "RGB, alpha": (3, [1]),
    "RGB, 1 more": (3, [0]),
    "RGB, 2 more": (3, [0, 0]),
    "RGB, 1 more, alpha": (3, [0, 2]),
    "RGB, 5 more": (3, [0] * 5),
}
COMPRESSIONS = {"none": 1, "PackBits": 32773, "LZW": 5, "Deflate": 8}


def pack_bits(data):
    """Literal runs of up to 128 bytes, and one run of equal bytes where there are some."""
    out, at = bytearray(), 0
    while at < len(data):
        run = 1
        while run < 128 and data[at : at + run + 1] == data[at : at + 1] * (run + 1):
            run += 1
        if run > 2:
            out += bytes([257 - run, data[at]])
            at += run
        else:
            part = data[at : at + 100]
            out += bytes([len(part) - 1]) + part
            at += len(part)
    return bytes(out)


def lzw(data):
    """TIFF 6.0, section 13: codes of 9 to 12 bits, the first bit first, one code early."""
    bits = []

    def put(code, size):
        bits.append(format(code, f"0{size}b"))

    table, size = {bytes([n]): n for n in range(256)}, 9
    put(256, 9)
    last = b""
    for n in range(len(data)):
        byte = data[n : n + 1]
        if last + byte in table:
            last += byte
            continue
        put(table[last], size)
        table[last + byte] = len(table) + 2
        # what has been put into the table needs so many bits, one early
        size = max(9, (len(table) + 2).bit_length())
        if len(table) + 2 >= 4094:
            put(256, size)
            table, size = {bytes([n]): n for n in range(256)}, 9
        last = byte
    put(table[last], size)
    put(257, max(9, (len(table) + 3).bit_length()))
    stream = "".join(bits)
    stream += "0" * (-len(stream) % 8)
    return int(stream, 2).to_bytes(len(stream) // 8, "big")


PACKED = {"none": bytes, "PackBits": pack_bits, "LZW": lzw, "Deflate": zlib.compress}


def predicted(rows, predictor, order):
    """Bytes of rows x columns x samples, each row after its predictor."""
    size = rows.dtype.itemsize
    if predictor == 2:
        whole = rows.view(f"u{size}")
        rows = whole.copy()
        rows[:, 1:] -= whole[:, :-1]
    if predictor == 3:
        # the most significant bytes of a row's numbers first, then differences between bytes as many apart as a pixel has samples
        count, apart = rows.shape[0], rows.shape[2]
        planes = rows.astype(rows.dtype.newbyteorder(">")).reshape(count, -1).view("u1").reshape(count, -1, size)
        whole = planes.transpose(0, 2, 1).reshape(count, -1)
        out = whole.copy()
        out[:, apart:] -= whole[:, :-apart]
        return out.tobytes()
    return rows.astype(rows.dtype.newbyteorder(order)).tobytes()


def chunks(picture, is_tiled):
    if not is_tiled:
        return [picture[y : y + ROWS_A_STRIP] for y in range(0, HEIGHT, ROWS_A_STRIP)]
    padded = np.pad(picture, ((0, -HEIGHT % TILE), (0, -WIDTH % TILE), (0, 0)), "edge")
    corners = itertools.product(range(0, HEIGHT, TILE), range(0, WIDTH, TILE))
    return [padded[y : y + TILE, x : x + TILE] for y, x in corners]


def write(path, picture, colours, extra, order, is_planar, is_tiled, compression, predictor):
    samples = picture.shape[2]
    planes = [picture[:, :, k : k + 1] for k in range(samples)] if is_planar else [picture]
    parts = [part for plane in planes for part in chunks(np.ascontiguousarray(plane), is_tiled)]
    parts = [PACKED[compression](predicted(np.ascontiguousarray(part), predictor, order)) for part in parts]
    data, offsets = b"", []
    for part in parts:
        offsets.append(8 + len(data))
        data += part + b"\0" * (len(part) % 2)
    tags = [
        (256, "H", [WIDTH]),
        (257, "H", [HEIGHT]),
        (258, "H", [8 * picture.dtype.itemsize] * samples),
        (259, "H", [COMPRESSIONS[compression]]),
        (262, "H", [2 if colours == 3 else 1]),
        (277, "H", [samples]),
        (284, "H", [2 if is_planar else 1]),
        (339, "H", [KINDS[picture.dtype.name]] * samples),
    ]
    if is_tiled:
        tags += [(322, "H", [TILE]), (323, "H", [TILE]), (324, "I", offsets), (325, "I", list(map(len, parts)))]
    else:
        tags += [(273, "I", offsets), (278, "H", [ROWS_A_STRIP]), (279, "I", list(map(len, parts)))]
    if predictor > 1:
        tags.append((317, "H", [predictor]))
    if extra:
        tags.append((338, "H", extra))
    tags.sort()
    at, table, behind = 8 + len(data), b"", b""
    for tag, kind, numbers in tags:
        values = struct.pack(f"{order}{len(numbers)}{kind}", *numbers)
        if len(values) > 4:
            place = at + 2 + 12 * len(tags) + 4 + len(behind)
            behind += values + b"\0" * (len(values) % 2)
            values = struct.pack(f"{order}I", place)
        table += struct.pack(f"{order}HHI", tag, 3 if kind == "H" else 4, len(numbers)) + values.ljust(4, b"\0")
    mark = b"II*\0" if order == "<" else b"MM\0*"
    head = mark + struct.pack(f"{order}I", at)
    with open(path, "wb") as file:
        file.write(head + data + struct.pack(f"{order}H", len(tags)) + table + bytes(4) + behind)


def pictures():
    random = np.random.default_rng(1)
    for kind, (name, (colours, extra)) in itertools.product(KINDS, SAMPLES.items()):
        light = random.uniform(0.02, 0.9, (HEIGHT, WIDTH, colours + len(extra)))
        # broad areas of one value, so that runs are packed and codes of LZW grow
        light[:9, :14] = 0.5 * light[0, 0]
        for k, what in enumerate(extra):
            if what:
                light[:, :, colours + k] = 1
        full = {"uint8": 255, "uint16": 65535, "uint32": 2**32 - 1, "int16": 32767}.get(kind)
        yield kind, name, colours, extra, (np.round(light * full) if full else light).astype(kind)


def main():
    n = 0
    for kind, name, colours, extra, picture in pictures():
        # one compression is enough for what nobody reads here
        compressions = ["none"] if kind in ("uint32", "int16") else COMPRESSIONS
        for is_planar, is_tiled, compression in itertools.product((0, 1), (0, 1), compressions):
            predictors = [1]
            if compression in ("LZW", "Deflate"):
                predictors += [2, 3] if kind.startswith("float") else [2]
            for predictor in predictors:
                order = "<>"[n % 2]
                write(f"{sys.argv[1]}/{n}.tif", picture, colours, extra, order, is_planar, is_tiled, compression, predictor)
                planes, cut = ["side by side", "planes"][is_planar], ["strips", "tiles"][is_tiled]
                print(n, kind, name, planes, cut, compression, predictor, "II" if order == "<" else "MM", sep="\t")
                n += 1


main()
