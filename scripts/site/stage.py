#!/usr/bin/env python3
"""stage.py PROGRAM FOLDER: lays out what Sphinx binds: FOLDER/pages, in FOLDER/gallery the gallery's scripts, and in
FOLDER/extra files that HTML in Markdown shows.

Pages are the repository's Markdown files with links that hold in their new places, and reference pages that the
program gives. A link to another file brings that file along.
"""

import pathlib
import posixpath
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import reference  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
MANUAL = "search/manual/"
LINK = re.compile(r"(\]\()([^)\s]+)(\))")
DRAWN = re.compile(r'((?:src|srcset)=")([^"]+)(")')  # of HTML, whose files Sphinx does not bring along
KINDS = ("tutorials", "how-to", "explanation", "reference")


def tracked():
    """All files of the project, and those that are new in this tree and not ignored."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            check=True, capture_output=True, text=True).stdout.splitlines()
    return {name for name in listed if (ROOT / name).is_file()}


def place(name):
    """Where on the site a file of the repository is."""
    if name.startswith(MANUAL):
        return name.removeprefix(MANUAL)
    if name.endswith(".md"):
        name = re.sub(r"(^|/)README\.md$", r"\1index.md", name)
        return "overview.md" if name == "index.md" else re.sub("^results/", "evidence/", f"code/{name}"
                                                               if not name.startswith("results/") else name)
    return f"files/{name}"


class Stage:
    """The pages so far, and what they bring along."""

    def __init__(self, folder):
        self.folder = folder
        self.files = tracked()
        self.brought = set()
        self.drawn = set()

    def target(self, name, link):
        """What a link of the file NAME is on the site."""
        path, _, anchor = link.partition("#")
        if re.match(r"[a-z]+:", link) or not path:
            return link
        to = posixpath.normpath(posixpath.join(posixpath.dirname(name), path))
        if to == "search/python/gallery" or to.startswith("search/python/gallery/"):
            to = MANUAL + "gallery/index.rst"
        elif (ROOT / to).is_dir():
            to = next((f"{to}/{page}" for page in ("README.md", "index.md") if f"{to}/{page}" in self.files), to)
            if (ROOT / to).is_dir():
                return None
        if not to.endswith(".md") and to in self.files:
            self.brought.add(to)
        here = posixpath.dirname(place(name))
        return posixpath.relpath(place(to), here or ".") + (f"#{anchor}" if anchor else "")

    def page(self, name, text):
        """Writes a page for the Markdown of the file NAME."""
        def moved(match):
            target = self.target(name, match[2])
            return match[0] if target is None else match[1] + target + match[3]

        def drawn(match):
            self.drawn.add(posixpath.normpath(posixpath.join(posixpath.dirname(name), match[2])))
            return moved(match)

        parts = re.split(r"(^```.*?^```$)", text, flags=re.M | re.S)
        text = "".join(part if part.startswith("```") else DRAWN.sub(drawn, LINK.sub(moved, part)) for part in parts)
        to = self.folder / "pages" / place(name)
        to.parent.mkdir(parents=True, exist_ok=True)
        front = "---\nhide-toc: true\n---\n\n" if name == MANUAL + "index.md" else ""
        to.write_text(front + text + self.contents(name, text), encoding="utf-8")

    def contents(self, name, text):
        """What the page at a folder's top leads to, in the order in which it names it."""
        if not re.search(r"(^|/)(README|index)\.md$", name) or name == "README.md":
            return ""
        if name == MANUAL + "index.md":
            return toctree(["gallery/index"] * self.has_gallery() + [f"{kind}/index" for kind in KINDS], "Manual") + \
                toctree(["overview", "evidence/index", "code/index"], "More")
        here = posixpath.dirname(place(name))
        named = [posixpath.normpath(match[2].partition("#")[0]) for match in LINK.finditer(text)]
        below = [posixpath.relpath(place(each), here) for each in sorted(self.files) if each.endswith(".md") and
                 place(each).startswith(here + "/") and self.parent(each) == name]
        order = [each for each in named if each.endswith(".md") and not each.startswith("..")]
        order += [each for each in below if each not in order]
        return toctree([each.removesuffix(".md") for each in dict.fromkeys(order) if each in below or
                        here == "reference"])

    def parent(self, name):
        """The page that leads to NAME: the nearest at the top of a folder."""
        folder = posixpath.dirname(name)
        own = re.search(r"(^|/)(README|index)\.md$", name)
        if own:
            folder = posixpath.dirname(folder)
        while folder:
            for page in ("README.md", "index.md"):
                if f"{folder}/{page}" in self.files and f"{folder}/{page}" != name:
                    return f"{folder}/{page}"
            folder = posixpath.dirname(folder)
        return ""

    def has_gallery(self):
        return any(re.fullmatch(r"search/python/gallery/[^/]+\.py", name) for name in self.files)


def toctree(pages, caption=None):
    lines = [f":caption: {caption}"] if caption else []
    return "\n\n```{toctree}\n:hidden:\n" + "\n".join(lines + [""] * bool(lines) + pages) + "\n```\n" if pages else ""


def gallery(stage):
    """The scripts, beside the patterns and campaigns that they name from the top of the repository."""
    to = stage.folder / "gallery"
    (to / "search").mkdir(parents=True)
    (to / "results").mkdir()
    for folder in ("patterns", "campaigns"):
        (to / "search" / folder).symlink_to(ROOT / "search" / folder)
    for script in sorted((ROOT / "search/python/gallery").glob("*.py")):
        shutil.copy(script, to)
    title, _, words = (ROOT / "search/python/gallery/README.md").read_text(encoding="utf-8").partition("\n")
    title = title.removeprefix("# ")
    words = re.sub(r"`([^`]+)`", r"``\1``", words)  # it is reStructuredText there
    (to / "README.txt").write_text(f"{title}\n{'=' * len(title)}\n\n{words.strip().split(chr(10) * 2)[0]}\n",
                                   encoding="utf-8")


def main():
    program, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    stage = Stage(folder)
    made = reference.pages(program)
    stage.files |= {MANUAL + name for name in made}
    stage.files.discard("search/python/gallery/README.md")  # sphinx-gallery makes a page of it
    for name in sorted(stage.files):
        if name.endswith(".md"):
            text = made.get(name.removeprefix(MANUAL)) if name.startswith(MANUAL) else None
            stage.page(name, text or (ROOT / name).read_text(encoding="utf-8"))
    code = [place(name).removeprefix("code/").removesuffix(".md") for name in sorted(stage.files)
            if place(name).startswith("code/") and not stage.parent(name)]
    (folder / "pages/code/index.md").write_text(
        "# The code\n\nHow it is built, and what its folders say of themselves.\n\n" +
        "".join(f"- [](<{each}.md>)\n" for each in code) + toctree(code), encoding="utf-8")
    for kind, names in (("pages", stage.brought - stage.drawn), ("extra", stage.drawn)):
        for name in sorted(names):
            to = folder / kind / place(name)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, to)
    if stage.has_gallery():
        gallery(stage)


if __name__ == "__main__":
    main()
