"""A drawing of a kit as a reader sees it: DXF through ezdxf, SVG through its XML. All y up, in mm."""

import re
import xml.etree.ElementTree as xml

import ezdxf

from stroke_reader import words_of

SVG = "{http://www.w3.org/2000/svg}"


class Drawing:
    """Layers by name in lower case: paths (points, closed), circles (x, y, r), texts (x, y, words, turned_deg). What is
    engraved is read from its lines."""

    def __init__(self, path):
        self.path = path
        self.paths, self.circles, self.texts = {}, {}, {}
        self.faults = []
        (self.read_dxf if path.endswith(".dxf") else self.read_svg)(path)
        if "engrave" in self.paths:
            if "engrave" in self.texts:
                self.faults.append("text where lines are engraved")
            self.texts["engrave"] = list(words_of(self.paths["engrave"]))

    def add(self, kind, layer, item):
        getattr(self, kind).setdefault(layer, []).append(item)

    def read_dxf(self, path):
        document = ezdxf.readfile(path)
        self.faults += [f"ezdxf: {error.message}" for error in document.audit().errors]
        if document.header["$INSUNITS"] != 4 or document.header["$MEASUREMENT"] != 1:
            self.faults.append("not in millimetres")
        self.size = tuple(document.header["$EXTMAX"])[:2]
        known = {layer.dxf.name for layer in document.layers}
        for entity in document.modelspace():
            layer, kind = entity.dxf.layer.lower(), entity.dxftype()
            if entity.dxf.layer not in known:
                self.faults.append(f"layer {entity.dxf.layer} is in no table")
            if kind == "LWPOLYLINE":
                self.add("paths", layer, ([(x, y) for x, y, *_ in entity.get_points()], bool(entity.closed)))
            elif kind == "LINE":
                self.add("paths", layer, ([tuple(entity.dxf.start)[:2], tuple(entity.dxf.end)[:2]], False))
            elif kind == "CIRCLE":
                self.add("circles", layer, (*tuple(entity.dxf.center)[:2], entity.dxf.radius))
            elif kind == "TEXT":
                at = entity.dxf.align_point if entity.dxf.halign else entity.dxf.insert
                self.add("texts", layer, (at[0], at[1], entity.dxf.text, entity.dxf.rotation))
            else:
                self.faults.append(f"a {kind}")

    def read_svg(self, path):
        root = xml.parse(path).getroot()
        box = [float(number) for number in root.get("viewBox").split()]
        if (root.get("width"), root.get("height")) != (f"{box[2]:.6f}".rstrip("0").rstrip(".") + "mm",
                                                       f"{box[3]:.6f}".rstrip("0").rstrip(".") + "mm"):
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
