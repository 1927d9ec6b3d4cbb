#!/usr/bin/env python3
"""Runs clang-tidy on what a build compiles, two units or more at a time: tidy.py BUILD [PATTERN] [--for SECONDS]
A unit that was clean, and of which no file nor what clang-tidy is told has changed since, is not looked at again
(BUILD/clean). With --for no unit is begun after so long: those that the last commits changed come first, the others in
an order of each commit's own, so that every unit has its turn."""

import argparse
import hashlib
import json
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TREE = Path(__file__).resolve().parent.parent
LAST_COMMITS = 10
INCLUDE = re.compile(r'^ *# *include "([^"]+)"', re.M)


def said(*command):
    return subprocess.run(command, cwd=TREE, capture_output=True, text=True).stdout


def files_of(path, roots, found):
    """The file and what it includes of this project and of what the build generates, directly or not."""
    if path in found or not path.is_file():
        return
    found[path] = path.read_bytes()
    for name in INCLUDE.findall(found[path].decode(errors="replace")):
        for root in (path.parent, *roots):
            if (root / name).is_file():
                files_of((root / name).resolve(), roots, found)
                break


class Unit:
    def __init__(self, entry, build, told):
        self.path, self.name = entry["file"], os.path.relpath(entry["file"], build.resolve()).removeprefix("../../")
        found = {}
        files_of(Path(self.path).resolve(), (TREE, build.resolve()), found)
        parts = [told, entry["command"].encode(), *(found[path] for path in sorted(found))]
        self.stamp = build / "clean" / hashlib.sha256(b"\0".join(parts)).hexdigest()
        self.sources = {os.path.relpath(path, TREE) for path in found if path.suffix == ".cpp"}

    def is_clean(self, build):
        run = subprocess.run(["clang-tidy", "-p", build, "-quiet", self.path], cwd=TREE, capture_output=True, text=True)
        if run.returncode:
            print(f"{self.name}:\n{run.stdout}{'' if run.stdout else run.stderr}", flush=True)
        else:
            self.stamp.touch()
        return run.returncode == 0


def units_of(build, pattern):
    told = (TREE / ".clang-tidy").read_bytes() + said("clang-tidy", "--version").encode()
    for entry in json.loads((build / "compile_commands.json").read_text()):
        # The same sources again; bytes of files, which the build generates.
        if "/misalign_first.dir/" in entry["file"] or "/schema_carried.dir/" in entry["file"]:
            continue
        unit = Unit(entry, build, told)
        if re.search(pattern, unit.name):
            yield unit


def in_turn(units):
    changed = set(said("git", "diff", "--name-only", f"HEAD~{LAST_COMMITS}").split())
    commit = said("git", "rev-parse", "HEAD")
    return sorted(units, key=lambda unit: (not unit.sources & changed,
                                           hashlib.sha256((commit + unit.name).encode()).digest()))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path)
    parser.add_argument("pattern", nargs="?", default="")
    parser.add_argument("--for", type=float, default=float("inf"), dest="most_s")
    call = parser.parse_args()
    (call.build / "clean").mkdir(exist_ok=True)
    units = list(units_of(call.build, call.pattern))
    changed = [unit for unit in in_turn(units) if not unit.stamp.exists()]
    begun = time.monotonic()

    def look(unit):
        return unit.is_clean(call.build) if time.monotonic() - begun < call.most_s else None

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        seen = list(pool.map(look, changed))
    print(f"clang-tidy: {len(seen) - seen.count(None)} of {len(units)} units looked at, {len(units) - len(changed)} clean "
          f"since before, {seen.count(None)} for another time")
    return seen.count(False) > 0


sys.exit(main())
