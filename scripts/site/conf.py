"""Tells Sphinx how scripts/site.sh makes the site."""

import os
import pathlib
import re

SITE = pathlib.Path(os.environ["MISALIGN_SITE"])
GALLERY = SITE / "gallery"

project = "misalign"
copyright = "the misalign developers"
source = (pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt").read_text(encoding="utf-8")
version = release = re.search(r"project\(misalign VERSION ([0-9.]+)", source)[1]

extensions = ["myst_parser"]
myst_heading_anchors = 4  # as GitHub makes them
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
suppress_warnings = ["myst.header"]
exclude_patterns = ["gallery/sg_execution_times.rst", "sg_execution_times.rst"]  # differ each time

html_theme = "furo"
html_title = f"misalign {release}"
html_show_sourcelink = False
html_copy_source = False
html_static_path = ["static"]
html_extra_path = [os.fspath(SITE / "extra")]
html_css_files = ["site.css"]
html_show_search_summary = False  # a page that is a file may not read others
html_search_scorer = os.path.join(os.path.dirname(__file__), "scorer.js")
# Those of the theme itself. Debian 12's package has lost them: its sass leaves out a media query within another.
html_theme_options = {"dark_css_variables": {f"color-{name}": value for name, value in {
    "problematic": "#ee5151", "foreground-primary": "#ffffffcc", "foreground-secondary": "#9ca0a5",
    "foreground-muted": "#81868d", "foreground-border": "#666666", "background-primary": "#131416",
    "background-secondary": "#1a1c1e", "background-hover": "#1e2124", "background-hover--transparent": "#1e212400",
    "background-border": "#303335", "background-item": "#444444", "brand-primary": "#2b8cee",
    "brand-content": "#368ce2", "highlighted-background": "#083563", "highlight-on-target": "#333300",
    "admonition-background": "#18181a"}.items()}}
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
        "min_reported_time": 1e9,  # the same pages whenever they are made
        "remove_config_comments": True,
    }
