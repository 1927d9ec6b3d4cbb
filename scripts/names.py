#!/usr/bin/env python3
"""Finds names that the code no longer has, in what is said of it: names.py [TREE]. Looked at are types, constants,
functions and files in backticks in Markdown and in comments, and in comments types, constants and files without them."""

import re
import subprocess
import sys
from pathlib import Path

CODE = {".cpp", ".hpp", ".js", ".mjs", ".py", ".pyi", ".sh", ".sql", ".json", ".txt", ".cmake", ".in", ".html", ".css"}
OF_ITS_TIME = ("CHANGELOG.md", "results/")  # true when it was written
# Styles, a parameter of Open MPI's, and what commands of the manual write.
NOT_OF_THE_CODE = set("CapWords snake_case if_include results/report.html stress/table1-stress.json kit/table1-kit.html".split())
COMMENT = re.compile(r"//.*")
QUOTED = re.compile(r"`([^`\n]+)`")
BARE = re.compile(r"\b(?:k[A-Z]\w+|(?:[A-Z][a-z0-9]+){2,})\b")
NAME = re.compile(r"(?:\w+::)*(\w+)(?:\(\))?")
IS_NAME = re.compile(r"k[A-Z]\w+|(?:[A-Z][a-z0-9]+){2,}|[a-z]\w*_\w+|MISALIGN_\w+")
BARE_PATH = re.compile(r"\b(?:(?:solver|schema|search|tests|scripts)/(?:[\w-]+/)*[\w-]+(?:\.\w+)?|results/[\w/-]+\.md)")
PLACEHOLDER = re.compile(r"\b(?:X|N|ROOM)(?:\b|_)")
PATH = re.compile(r"(?:[\w.-]+/)+[\w.-]+")


def tracked(tree):
    names = subprocess.run(["git", "-C", tree, "ls-files"], check=True, capture_output=True, text=True).stdout
    return [Path(name) for name in names.splitlines() if (tree / name).is_file()]


def texts(tree, files):
    return {file: (tree / file).read_text(errors="replace") for file in files}


def words_of(codes):
    found = set()
    for file, text in codes.items():
        found |= set(re.findall(r"\w+", COMMENT.sub("", text) if file.suffix in {".cpp", ".hpp"} else text))
    return found


def stands(path, places):
    return any(place.endswith(f"/{path}") or f"/{path}." in place or f"/{path}/" in place for place in places)


def stale(tree):
    files = tracked(tree)
    codes = texts(tree, [file for file in files if file.suffix in CODE])
    words = words_of(codes) | {file.stem for file in files} | NOT_OF_THE_CODE
    places = [f"/{file}" for file in files]
    said = texts(tree, [file for file in files if file.suffix == ".md" and not str(file).startswith(OF_ITS_TIME)])
    said |= {file: text for file, text in codes.items() if file.suffix in {".cpp", ".hpp"}}
    for file, text in said.items():
        for number, line in enumerate(text.splitlines(), 1):
            names, paths = [], []
            if file.suffix != ".md":
                line = "".join(COMMENT.findall(line))
                names, paths = BARE.findall(line), [path for path in BARE_PATH.findall(line) if not PLACEHOLDER.search(path)]
            for quoted in QUOTED.findall(line):
                name = NAME.fullmatch(quoted)
                names += [name[1]] if name and IS_NAME.fullmatch(name[1]) else []
                paths += [quoted] if PATH.fullmatch(quoted) and not PLACEHOLDER.search(quoted) else []
            for name in dict.fromkeys(names):
                if name not in words:
                    yield f"{file}:{number}: {name}: the code has no such name"
            for path in dict.fromkeys(paths):
                if path not in words and not path.startswith(("build/", "/")) and not stands(path.rstrip("/"), places):
                    yield f"{file}:{number}: {path}: there is no such file"


sys.exit("\n".join(stale(Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent))) or 0)
