#!/usr/bin/env python3
"""isolation_oracle.py LAYER PROGRAM CUTTER_MM LOSS_MM [DPI]: judges an isolation program in pixels.

gerbv draws the layer, and the cuts of the program are drawn over it as wide as the cutter. Prints the number of islands
of copper, of those that are still joined to another one, of those that fell apart, and the copper that is lost: its
area in mm2 without the outermost pixel of each island, which the rim crosses, and "deep" if any is farther from the
rim than LOSS_MM and two pixels. With DPI, says where islands are joined. Shares no code with Passo. Needs gerbv, and
numpy, scipy and Pillow for Python.
"""
import math
import re
import subprocess
import sys
import tempfile

import numpy
from PIL import Image
from scipy import ndimage

Image.MAX_IMAGE_PIXELS = None


def cuts(program):
    """The lines of all cuts below Z0; arcs as chords."""
    x = y = z = 0.0
    motion = 0
    for line in re.sub(r"\([^)]*\)", "", program).splitlines():
        words = {letter: float(value) for letter, value in re.findall(r"([XYZIJ])(-?[0-9.]+)", line)}
        found = re.search(r"G([0123])(?![0-9.])", line)
        motion = int(found[1]) if found else motion
        if not words:
            continue
        to_x, to_y, z = words.get("X", x), words.get("Y", y), words.get("Z", z)
        if motion > 0 and z < 0:
            if motion == 1:
                yield x, y, to_x, to_y
            else:
                centre_x, centre_y = x + words.get("I", 0), y + words.get("J", 0)
                radius = math.hypot(x - centre_x, y - centre_y)
                begin = math.atan2(y - centre_y, x - centre_x)
                sweep = math.atan2(to_y - centre_y, to_x - centre_x) - begin
                sweep %= 2 * math.pi
                sweep = sweep - 2 * math.pi if motion == 2 else sweep
                if motion == 3 and sweep == 0:
                    sweep = 2 * math.pi
                count = 1 + int(abs(sweep) * math.sqrt(max(radius, 0.01) / 0.008))
                at = x, y
                for i in range(1, count + 1):
                    angle = begin + sweep * i / count
                    next_at = centre_x + radius * math.cos(angle), centre_y + radius * math.sin(angle)
                    yield *at, *next_at
                    at = next_at
        x, y = to_x, to_y


def main():
    layer, path, cutter, loss = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4])
    with open(path, encoding="utf-8") as file:
        lines = numpy.array(list(cuts(file.read())))
    low = numpy.minimum(lines[:, :2].min(0), lines[:, 2:].min(0)) - 1
    high = numpy.maximum(lines[:, :2].max(0), lines[:, 2:].max(0)) + 1
    size = high - low
    dpi = 5080 if size[0] * size[1] < 3000 else 2540
    if len(sys.argv) > 5:
        dpi = int(sys.argv[5])
    pixel = 25.4 / dpi
    with tempfile.NamedTemporaryFile(suffix=".png") as picture:
        subprocess.run(["gerbv", "-x", "png", "-o", picture.name, f"--dpi={dpi}", "-B", "0",
                        f"--origin={low[0] / 25.4:.6f}x{low[1] / 25.4:.6f}",
                        f"--window_inch={size[0] / 25.4:.6f}x{size[1] / 25.4:.6f}",
                        "-b", "#000000", "-f", "#ffffffff", layer], check=True, capture_output=True)
        copper = numpy.asarray(Image.open(picture.name).convert("L"))[::-1] > 127
    left = numpy.ones_like(copper)
    radius = cutter / 2 / pixel
    for x0, y0, x1, y1 in (lines - numpy.concatenate([low, low])) / pixel - 0.5:
        first_x, last_x = int(min(x0, x1) - radius), int(max(x0, x1) + radius) + 2
        first_y, last_y = int(min(y0, y1) - radius), int(max(y0, y1) + radius) + 2
        if (last_x - first_x) * (last_y - first_y) > 4_000_000:
            steps = 1 + int(math.hypot(x1 - x0, y1 - y0) / 500)
        else:
            steps = 1
        for i in range(steps):
            a_x, a_y = x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps
            b_x, b_y = x0 + (x1 - x0) * (i + 1) / steps, y0 + (y1 - y0) * (i + 1) / steps
            first_x, last_x = max(0, int(min(a_x, b_x) - radius)), int(max(a_x, b_x) + radius) + 2
            first_y, last_y = max(0, int(min(a_y, b_y) - radius)), int(max(a_y, b_y) + radius) + 2
            rows, columns = numpy.ogrid[first_y:last_y, first_x:last_x]
            square = (b_x - a_x) ** 2 + (b_y - a_y) ** 2
            along = 0
            if square > 0:
                along = ((columns - a_x) * (b_x - a_x) + (rows - a_y) * (b_y - a_y)) / square
                along = numpy.clip(along, 0, 1)
            away = (columns - a_x - along * (b_x - a_x)) ** 2 + (rows - a_y - along * (b_y - a_y)) ** 2
            part = left[first_y:last_y, first_x:last_x]
            part &= away[: part.shape[0], : part.shape[1]] > radius * radius
    islands, count = ndimage.label(copper)
    # Where gerbv draws areas as stripes, single pixels may be left of their seams.
    specks = numpy.bincount(islands.ravel()) < 0.002 / pixel**2
    count -= int(specks[1:].sum())
    islands[specks[islands]] = 0
    copper = islands > 0
    pieces, _ = ndimage.label(left)
    stays = copper & left
    pairs = islands[stays].astype(numpy.int64) << 32 | pieces[stays]
    keys, sizes = numpy.unique(pairs, return_counts=True)
    largest, apart = {}, {}
    for key, pixels in zip(keys.tolist(), sizes.tolist()):
        island, piece = key >> 32, key & 0xFFFFFFFF
        apart.setdefault(island, []).append(pixels)
        if pixels > largest.get(island, (0, 0))[0]:
            largest[island] = pixels, piece
    owners = {}
    for _, piece in largest.values():
        owners[piece] = owners.get(piece, 0) + 1
    joined = sum(number for number in owners.values() if number > 1)
    broken = sum(1 for parts in apart.values() if sum(parts) - max(parts) > 0.002 / pixel**2)
    if len(sys.argv) > 5:
        for island, (_, piece) in largest.items():
            if owners[piece] > 1:
                row, column = numpy.argwhere((islands == island) & left)[0]
                print(f"island {island} is joined in piece {piece}, e.g. at X{low[0] + column * pixel:.3f} Y{low[1] + row * pixel:.3f}")
    inner = copper.copy()
    lost = 0.0
    for i in range(int(loss / pixel) + 2):
        shrunk = inner.copy()
        shrunk[1:] &= inner[:-1]
        shrunk[:-1] &= inner[1:]
        shrunk[:, 1:] &= inner[:, :-1]
        shrunk[:, :-1] &= inner[:, 1:]
        if i % 2:  # an octagon is nearly a disc
            shrunk[1:, 1:] &= inner[:-1, :-1]
            shrunk[:-1, :-1] &= inner[1:, 1:]
        inner = shrunk
        if i == 0:
            lost = float((inner & ~left).sum()) * pixel**2
    deep = bool((inner & ~left).any())
    print(f"{count} islands, {joined} joined, {broken} broken, {lost:.2f} mm2 lost{', deep' if deep else ''}")


main()
