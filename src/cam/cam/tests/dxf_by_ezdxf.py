"""The entities of DXF drawings as ezdxf has them, for ezdxf_test.cpp: a line for each file whose name is on standard input.

PLACES LENGTH, in the file's unit: how many circles and points there are, and how long all lines and circles are together.
Blocks are expanded; dimensions, and layers that are off or frozen, are left out. A polyline of two half circles is a circle.
"""
import logging
import math
import sys
import warnings

import ezdxf
from ezdxf import path, recover
from ezdxf.disassemble import recursive_decompose

warnings.simplefilter("ignore")
logging.disable(logging.CRITICAL)
LINES = {"LINE", "ARC", "LWPOLYLINE", "POLYLINE", "ELLIPSE", "SPLINE"}


def is_circle(entity):
    if not entity.dxftype().endswith("POLYLINE") or not entity.is_closed:
        return False
    if entity.dxftype() == "LWPOLYLINE":
        bulges = [point[0] for point in entity.get_points("b")]
    else:
        bulges = [vertex.dxf.bulge for vertex in entity.vertices]
    return len(bulges) == 2 and all(abs(abs(bulge) - 1) < 1e-6 for bulge in bulges)


def entities_of(name):
    try:
        document = ezdxf.readfile(name)
    except Exception:  # a file that only the reader of broken files takes
        document, _ = recover.readfile(name)
    off = {layer.dxf.name.lower() for layer in document.layers if layer.is_off() or layer.is_frozen()}
    places, length = 0, 0.0
    drawn = [entity for entity in document.modelspace() if entity.dxftype() not in ("DIMENSION", "LEADER")]
    for entity in recursive_decompose(drawn):
        kind = entity.dxftype()
        if entity.dxf.layer.lower() in off or entity.dxf.get("invisible", 0):
            continue
        if kind in ("POINT", "CIRCLE"):
            places += 1
            length += 2 * math.pi * abs(entity.dxf.radius) if kind == "CIRCLE" else 0
        elif kind in LINES:
            places += is_circle(entity)
            if kind == "ELLIPSE" and (entity.dxf.end_param - entity.dxf.start_param) % math.tau < 1e-9:
                entity.dxf.end_param = entity.dxf.start_param + math.tau  # ezdxf makes nothing of a whole one
            try:
                points = list(path.make_path(entity).flattening(1e-4))
            except TypeError:  # a mesh
                continue
            length += sum(math.hypot(b.x - a.x, b.y - a.y) for a, b in zip(points, points[1:]))
    return f"{places} {length:.9g}"


for line in sys.stdin:
    try:
        print(entities_of(line.rstrip("\n")))
    except Exception as error:
        print(f"- {type(error).__name__}")
