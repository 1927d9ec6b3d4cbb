"""A drawing of a kit as a reader sees it: DXF through ezdxf, SVG through its XML. All y up, in mm."""

import math
import re
import xml.etree.ElementTree as xml

import ezdxf

from stroke_reader import words_of

LONG, SHARE = 5, 0.3  # mm, and share of the longest: sides of panels, not of tabs or trimmed corners

SVG = "{http://www.w3.org/2000/svg}"


def sides_of(ring):
    return list(zip(ring, ring[1:] + ring[:1]))


def area(ring):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in sides_of(ring)) / 2


def inside(point, ring):
    x, y = point
    return sum((p[1] > y) != (q[1] > y) and x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
               for p, q in sides_of(ring)) % 2 == 1


def turns_of(ring, directions):
    """Turns (radians) of a sheet whose sides have these directions that lay some along each long side of the ring."""
    off = lambda a, b: abs((a - b + math.pi / 2) % math.pi - math.pi / 2)
    least = max(LONG, SHARE * max(math.dist(p, q) for p, q in sides_of(ring)))
    long = [math.atan2(q[1] - p[1], q[0] - p[0]) for p, q in sides_of(ring) if math.dist(p, q) > least]
    turns = []
    for direction in directions:
        turn = long[0] - direction
        if all(min(off(side, turn + other) for other in directions) < 0.05 for side in long):
            turns += [turn % (2 * math.pi), (turn + math.pi) % (2 * math.pi)]
    apart = []
    for turn in turns:
        if all(abs((turn - other + math.pi) % (2 * math.pi) - math.pi) > 0.03 for other in apart):
            apart.append(turn)
    return apart or [0.0]


class Drawing:
    """Layers by name in lower case: paths (points, closed), circles (x, y, r), texts (x, y, words, turned_deg). What is
    engraved is read from its lines, see read_words."""

    def __init__(self, path):
        self.path = path
        self.paths, self.circles, self.texts = {}, {}, {}
        self.faults = []
        (self.read_dxf if path.endswith(".dxf") else self.read_svg)(path)
        if "engrave" in self.paths and self.texts:
            self.faults.append("text where lines are engraved")

    def add(self, kind, layer, item):
        getattr(self, kind).setdefault(layer, []).append(item)

    def read_words(self, directions):
        """Reads what is engraved within each outer contour, turned by an angle that lays the contour's long sides along
        `directions` (radians, of the sheet's sides)."""
        if "engrave" in self.texts or "engrave" not in self.paths:
            return
        groups = {}
        outer = [points for points, _ in self.paths["cut"]]
        for path in self.paths["engrave"]:
            homes = [k for k, ring in enumerate(outer) if inside(path[0][0], ring)]
            groups.setdefault(min(homes, key=lambda k: abs(area(outer[k])), default=-1), []).append(path)
        self.texts["engrave"] = [word for k, paths in groups.items()
                                 for word in words_of(paths, turns_of(outer[k], directions) if k >= 0 else [0.0])]

    def read_dxf(self, path):
        document = ezdxf.readfile(path)
        self.faults += [f"ezdxf: {error.message}" for error in document.audit().errors]
        units = {(4, 1): 1.0, (1, 0): 25.4}
        self.unit = units.get((document.header["$INSUNITS"], document.header["$MEASUREMENT"]))
        if self.unit is None:
            self.faults.append("neither in millimetres nor in inches")
            self.unit = 1.0
        unit = lambda at: tuple(self.unit * n for n in tuple(at)[:2])
        self.size = unit(document.header["$EXTMAX"])
        known = {layer.dxf.name for layer in document.layers}
        for entity in document.modelspace():
            layer, kind = entity.dxf.layer.lower(), entity.dxftype()
            if entity.dxf.layer not in known:
                self.faults.append(f"layer {entity.dxf.layer} is in no table")
            if kind == "LWPOLYLINE":
                self.add("paths", layer, ([unit(at) for at in entity.get_points()], bool(entity.closed)))
            elif kind == "LINE":
                self.add("paths", layer, ([unit(entity.dxf.start), unit(entity.dxf.end)], False))
            elif kind == "CIRCLE":
                self.add("circles", layer, (*unit(entity.dxf.center), self.unit * entity.dxf.radius))
            elif kind == "TEXT":
                at = entity.dxf.align_point if entity.dxf.halign else entity.dxf.insert
                self.add("texts", layer, (*unit(at), entity.dxf.text, entity.dxf.rotation))
            else:
                self.faults.append(f"a {kind}")

    def read_svg(self, path):
        root = xml.parse(path).getroot()
        box = [float(number) for number in root.get("viewBox").split()]
        sizes = [re.fullmatch(r"([\d.]+)(mm|in)", root.get(name)) for name in ("width", "height")]
        self.unit = 25.4 if sizes[0][2] == "in" else 1.0
        if sizes[0][2] != sizes[1][2] or any(abs(self.unit * float(size[1]) - n) > 2e-5
                                             for size, n in zip(sizes, box[2:])):
            self.faults.append("a user unit is no millimetre")
        self.size = (box[2], box[3])
        for group in root.findall(SVG + "g"):
            layer = group.get("id")
            for tag in group.iter():
                if tag.tag == SVG + "path":
                    numbers = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", tag.get("d"))]
                    points = [(x, box[3] - y) for x, y in zip(numbers[::2], numbers[1::2])]
                    self.add("paths", layer, (points, tag.get("d").endswith("Z")))
                elif tag.tag == SVG + "circle":
                    self.add("circles", layer,
                             (float(tag.get("cx")), box[3] - float(tag.get("cy")), float(tag.get("r"))))
                elif tag.tag == SVG + "text":
                    turned = re.match(r"rotate\((-?[\d.]+)", tag.get("transform", ""))
                    self.add("texts", layer, (float(tag.get("x")), box[3] - float(tag.get("y")), tag.text,
                                              -float(turned[1]) if turned else 0.0))
