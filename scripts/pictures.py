#!/usr/bin/env python3
"""What scripts/pictures.sh does with pictures.

pictures.py figure NAME FILE         draws a figure of search/python/gallery as a small PNG
pictures.py smaller FILE...          leaves 128 colours of each PNG
pictures.py moving FOLDER FILE       the PNGs of a folder by name, there and back, as an animated WebP
"""

import runpy
import sys
from pathlib import Path

from PIL import Image

GALLERY = Path(__file__).resolve().parent.parent / "search/python/gallery"
DOTS_PER_INCH, COLOURS = 80, 128
FRAME_MS, END_MS, WIDE, QUALITY = 60, 900, 900, 70


def figure(name, file):
    import matplotlib.pyplot as plt
    plt.show = lambda: None
    runpy.run_path(str(GALLERY / f"{name}.py"))
    plt.savefig(file, dpi=DOTS_PER_INCH)
    smaller(file)


def smaller(*files):
    for file in files:
        with Image.open(file) as picture:
            picture.convert("RGB").quantize(COLOURS, Image.Quantize.LIBIMAGEQUANT).save(file, optimize=True)


def moving(folder, file):
    pictures = [Image.open(each).convert("RGB") for each in sorted(Path(folder).glob("*.png"))]
    high = round(pictures[0].height * WIDE / pictures[0].width)
    frames = [picture.resize((WIDE, high), Image.Resampling.LANCZOS) for picture in pictures]
    times = [END_MS] + [FRAME_MS] * (len(frames) - 2) + [END_MS] + [FRAME_MS] * (len(frames) - 2)
    frames += frames[-2:0:-1]
    frames[0].save(file, save_all=True, append_images=frames[1:], duration=times, loop=0, quality=QUALITY, method=4)


if __name__ == "__main__":
    {"figure": figure, "smaller": smaller, "moving": moving}[sys.argv[1]](*sys.argv[2:])
