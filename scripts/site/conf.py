"""Tells Sphinx how scripts/site.sh makes the site."""

import os
import pathlib
import re

SITE = pathlib.Path(__file__).resolve().parents[2] / "build" / "site"
GALLERY = SITE / "gallery"

project = "misalign"
copyright = "the misalign developers"
source = (pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt").read_text(encoding="utf-8")
version = release = re.search(r"project\(misalign VERSION ([0-9.]+)", source)[1]

extensions = ["myst_parser"]
myst_heading_anchors = 4  # as GitHub makes them
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
suppress_warnings = ["myst.header"]

html_theme = "furo"
html_title = f"misalign {release}"
html_show_sourcelink = False
html_copy_source = False
html_static_path = []
pygments_style = "tango"
pygments_dark_style = "monokai"

if any(GALLERY.glob("*.py")):
    extensions.append("sphinx_gallery.gen_gallery")
    sphinx_gallery_conf = {
        "examples_dirs": os.fspath(GALLERY),
        "gallery_dirs": "gallery",
        "filename_pattern": r"\.py$",
        "abort_on_example_error": True,
        "download_all_examples": False,
        "show_memory": False,
        "remove_config_comments": True,
    }
