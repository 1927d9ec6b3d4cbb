"""The page of a sheet in a notebook."""

from __future__ import annotations

import html
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from misalign._error import Error
from misalign._numbers import whole
from misalign._pattern import Pattern


def _program() -> str:
    """Returns the path of the program: that of the same build or prefix, or the first one in PATH."""
    for folder in Path(__file__).resolve().parents:
        for place in (folder / "misalign", folder / "bin/misalign"):
            if place.is_file() and os.access(place, os.X_OK):
                return str(place)
    found = shutil.which("misalign")
    if found is None:
        raise Error("the program misalign is missing, which makes the page (it is neither beside this package nor in PATH); "
                    "install it, or add its folder to PATH")
    return found


def _page(sheet: Pattern) -> str:
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, (re.sub(r"[^\w .-]", "-", sheet.name)[:100].strip(". ") or "sheet") + ".json")
        page = os.path.join(folder, "page.html")
        sheet.write(file)
        done = subprocess.run([_program(), "report", file, "--output", page, "--log-level", "error", "--color", "never"],
                              capture_output=True, text=True)
        if done.returncode != 0:
            raise Error(done.stderr.strip().removeprefix("misalign: ") or "misalign report ended without a word", done.returncode)
        with open(page, encoding="utf-8") as made:
            return made.read()


class View:
    """The page of a sheet, which notebooks show. Made by `misalign.view`.

    `page`       the page, HTML
    `height_px`  height of its frame in a notebook

    >>> misalign.view(misalign.read("search/patterns/table1.json")).page[:15]
    '<!doctype html>'
    """

    def __init__(self, page: str, height_px: int) -> None:
        self.page = page
        self.height_px = height_px

    def __repr__(self) -> str:
        return f"<misalign.View: a page of {len(self.page) / 1e6:.1f} MB, {self.height_px} px high>"

    def _repr_html_(self) -> str:
        return (f'<iframe title="sheet" sandbox="allow-scripts allow-downloads" srcdoc="{html.escape(self.page)}" '
                f'style="width: 100%; height: {self.height_px}px; border: 0"></iframe>')


def view(sheet: Pattern, height_px: int = 720) -> View:
    """Shows a sheet in a notebook, to fold and turn: the page of `misalign report`, in a frame. It needs no network.

    `sheet`      a pattern, such as `Catalogue.pattern` returns
    `height_px`  height of the frame, pixels, from 1 to 100000

    The program makes the page, about 1 MB: that of the same build as this package, or the first one in PATH.
    `misalign.Error`: 1 without a program, or where it has no report; 2 for what is no pattern, and for what is no height.

    >>> misalign.view(misalign.read("search/patterns/table1.json"), height_px=600).height_px
    600
    """
    if not isinstance(sheet, Pattern):
        raise Error(f"{sheet!r}: is no pattern; give one, such as misalign.read and Catalogue.pattern return", 2)
    height_px = whole("height_px", height_px, 1, 100000)
    return View(_page(sheet), height_px)
