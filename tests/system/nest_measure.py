"""How closely a kit's parts are nested: nest_measure.py WITHIN MARGIN FILE...

The files are the beds of one kit, in order. Compares the length that the parts take of a strip as wide as a bed within
its margin (all beds but the last whole) with the lower bound, the parts' area over that width. Ends with 1 if the length
is more than WITHIN times the bound."""

import sys

from kit_drawing import Drawing, area


def main():
    within, margin = map(float, sys.argv[1:3])
    drawings = [Drawing(path) for path in sys.argv[3:]]
    width, height = (n - 2 * margin for n in drawings[0].size)
    total = sum(area(ring) for drawing in drawings for layer in ("cut", "opening")
                for ring, _ in drawing.paths.get(layer, []))
    top = max(y for ring, _ in drawings[-1].paths["cut"] for _, y in ring) - margin
    length, bound = (len(drawings) - 1) * height + top, total / width
    print(f"{len(drawings)} beds of {width + 2 * margin:g} x {height + 2 * margin:g}: {length:.0f} mm of a bound of "
          f"{bound:.0f}, {100 * (length / bound - 1):.1f} % more")
    sys.exit(length > within * bound)


main()
