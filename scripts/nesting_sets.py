#!/usr/bin/env python3
"""Writes five sets of parts for scripts/nesting_table.sh: NAME.svg, and the same polygons as NAME.json."""
import json
import math
import random
import sys


def box(width, height):
    return [(0, 0), (width, 0), (width, height), (0, height)]


def ell(long, short, width):
    return [(0, 0), (long, 0), (long, width), (width, width), (width, short), (0, short)]


def disc(radius, corners=72):
    return [(radius * math.cos(2 * math.pi * i / corners), radius * math.sin(2 * math.pi * i / corners)) for i in range(corners)]


def gear(teeth, module):
    ring = []
    for i in range(teeth):
        for share, radius in ((0.0, -1.25), (0.18, 1.0), (0.42, 1.0), (0.6, -1.25)):
            angle = 2 * math.pi * (i + share) / teeth
            ring.append(((teeth / 2 + radius) * module * math.cos(angle), (teeth / 2 + radius) * module * math.sin(angle)))
    return ring


LETTERS = {
    "E": [(0, 0), (6, 0), (6, 2), (2, 2), (2, 4), (5, 4), (5, 6), (2, 6), (2, 8), (6, 8), (6, 10), (0, 10)],
    "T": [(2, 0), (4, 0), (4, 8), (6, 8), (6, 10), (0, 10), (0, 8), (2, 8)],
    "K": [(0, 0), (2, 0), (2, 4), (4.5, 0), (7, 0), (3.7, 5), (7, 10), (4.5, 10), (2, 6), (2, 10), (0, 10)],
    "V": [(2.6, 0), (4.4, 0), (7, 10), (5, 10), (3.5, 4), (2, 10), (0, 10)],
    "Z": [(0, 0), (6, 0), (6, 2), (2.6, 2), (6, 8), (6, 10), (0, 10), (0, 8), (3.4, 8), (0, 2)],
    "U": [(2, 0), (4, 0), (6, 2), (6, 10), (4, 10), (4, 2.8), (3.2, 2), (2.8, 2), (2, 2.8), (2, 10), (0, 10), (0, 2)],
    "F": [(0, 0), (2, 0), (2, 4), (5, 4), (5, 6), (2, 6), (2, 8), (6, 8), (6, 10), (0, 10)],
    "Y": [(2.5, 0), (4.5, 0), (4.5, 4), (7, 10), (4.8, 10), (3.5, 6.4), (2.2, 10), (0, 10), (2.5, 4)],
    "S": [(0, 1), (1, 0), (5, 0), (6, 1), (6, 5), (5, 6), (2, 6), (2, 8), (6, 8), (6, 10), (1, 10), (0, 9), (0, 5), (1, 4), (4, 4), (4, 2), (0, 2)],
}


def scaled(ring, by):
    return [(x * by, y * by) for x, y in ring]


def hook(radius, width):
    outer = [(radius * math.cos(a), radius * math.sin(a)) for a in (math.pi * i / 24 for i in range(-6, 31))]
    inner = [((radius - width) * math.cos(a), (radius - width) * math.sin(a)) for a in (math.pi * i / 24 for i in range(30, -7, -1))]
    return outer + inner


def sets():
    rng = random.Random(48)
    rectangles = [(box(rng.randrange(25, 130), rng.randrange(20, 90)), 1) for _ in range(36)]
    ells = [(ell(90, 70, 22), 8), (ell(60, 60, 18), 12), (ell(50, 30, 12), 16)]
    gears = [(gear(12, 3), 8), (gear(20, 2.5), 8), (gear(32, 2.5), 4), (disc(12), 12), (disc(22), 6)]
    letters = [(scaled(ring, 8), 4) for ring in LETTERS.values()]
    mixed = [(hook(35, 12), 5), ([(0, 0), (80, 0), (0, 50)], 6), ([(0, 0), (70, 0), (50, 40), (20, 40)], 6), (ell(70, 40, 15), 5),
             ([(20 * (2.2 if i % 2 else 1) * math.cos(math.pi * i / 5), 20 * (2.2 if i % 2 else 1) * math.sin(math.pi * i / 5)) for i in range(10)], 5),
             (disc(18), 6), (box(60, 25), 6)]
    return {"rectangles": rectangles, "ells": ells, "gears": gears, "letters": letters, "mixed": mixed}


def write(folder):
    for name, parts in sets().items():
        paths = []
        polygons = []
        x = 0
        for ring, quantity in parts:
            left = min(p[0] for p in ring)
            width = max(p[0] for p in ring) - left
            for _ in range(quantity):
                moved = [(round(px - left + x, 4), round(py, 4)) for px, py in ring]
                polygons.append(moved)
                paths.append("M" + "L".join(f"{px:.4f} {py:.4f}" for px, py in moved) + "Z")
                x += width + 10
        with open(f"{folder}/{name}.svg", "w", encoding="utf-8") as svg:
            svg.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{x:.0f}mm" height="200mm" viewBox="0 -100 {x:.0f} 200">'
                      + "".join(f'<path d="{d}"/>' for d in paths) + "</svg>\n")
        with open(f"{folder}/{name}.json", "w", encoding="utf-8") as out:
            json.dump(polygons, out)


if __name__ == "__main__":
    write(sys.argv[1] if len(sys.argv) > 1 else ".")
