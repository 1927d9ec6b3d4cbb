#!/usr/bin/env python3
"""Checks what is written for people: manual.py

README has at most 150 lines. Links and anchors between Markdown files lead somewhere. Pages of the manual name their kind
and are in their index. No sentence of over twelve words is said on two pages. Pages that the program names exist.
"""

import collections
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINES_OF_README = 150
WORDS_SAID_ONCE = 12
KIND = {"tutorials": "Tutorial", "how-to": "How-to", "explanation": "Explanation", "reference": "Reference"}
MANUAL = "search/manual/"


def files(*patterns):
    return subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns], cwd=ROOT,
                          check=True, capture_output=True, text=True).stdout.splitlines()


def without_code(text):
    """The same lines, empty where they are code."""
    inside = False
    out = []
    for line in text.split("\n"):
        fence = line.lstrip().startswith("```")
        out.append("" if inside or fence or line.startswith("    ") else line)
        inside ^= fence
    return "\n".join(out)


def anchors(text):
    """Of the headings, as GitHub and the site make them."""
    seen = collections.Counter()
    for title in re.findall(r"^#+ +(.*)$", without_code(text), re.M):
        slug = re.sub(r"[^\w\- ]", "", re.sub(r"\[(.*?)\]\(.*?\)", r"\1", title).lower()).replace(" ", "-")
        yield slug + (f"-{seen[slug]}" if seen[slug] else "")
        seen[slug] += 1


def faults_of_links(pages):
    known = {name: set(anchors(text)) for name, text in pages.items()}
    for name, text in pages.items():
        for link in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            to = os.path.normpath(os.path.join(os.path.dirname(name), path)) if path else name
            if not (ROOT / to).exists():
                yield f"{name}: {link} leads nowhere"
            elif anchor and anchor not in known.get(to, ()):
                yield f"{name}: {link}: there is no such heading"


def faults_of_kinds(pages):
    for name, text in pages.items():
        folder, _, page = name.removeprefix(MANUAL).rpartition("/")
        if not name.startswith(MANUAL) or not folder:
            continue
        if not re.match(rf"# .+\n\n\*{KIND[folder]}\.\* \S", text):
            yield f"{name}: begins with no title and its kind, *{KIND[folder]}.*, with what it gives"
        if page != "index.md" and f"]({page})" not in pages[f"{MANUAL}{folder}/index.md"]:
            yield f"{name}: {folder}/index.md does not name it"


def sentences(text):
    """Each sentence, cell and item, as its words."""
    text = re.sub(r"\]\([^)]*\)", "]", without_code(text))
    blocks = re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) |\n#+ |\|", text)
    for block in blocks:
        for sentence in re.split(r"(?<=[.!?:;])\s+", re.sub(r"\s+", " ", block)):
            yield re.findall(r"[\w°′'’%.×⁻-]*\w", sentence.lower())


def faults_of_repetition(pages):
    places = collections.defaultdict(set)
    for name, text in pages.items():
        for words in sentences(text):
            if len(words) > WORDS_SAID_ONCE:
                places[" ".join(words)].add(name)
    for sentence, names in places.items():
        if len(names) > 1:
            yield f"{' and '.join(sorted(names))} both say: {sentence}"


def faults_of_names():
    """Pages that texts of the program name."""
    for name in files("*.cpp", "*.hpp", "*.html", "*.js", "*.h2m", "schema/*.json"):
        for page in re.findall(r"\w[\w./-]*/[\w.-]+\.md\b", (ROOT / name).read_text(encoding="utf-8")):
            if not (ROOT / page).exists() and not (ROOT / name).parent.joinpath(page).exists():
                yield f"{name}: names {page}, which is not there"


def main():
    pages = {name: (ROOT / name).read_text(encoding="utf-8") for name in files("*.md") if (ROOT / name).is_file()}
    long = pages["README.md"].count("\n")
    faults = [f"README.md: {long} lines, not {LINES_OF_README}"] if long > LINES_OF_README else []
    faults += [*faults_of_links(pages), *faults_of_kinds(pages), *faults_of_repetition(pages), *faults_of_names()]
    print("\n".join(faults), end="\n" * bool(faults), file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
