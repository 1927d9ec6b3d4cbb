#!/usr/bin/env python3
"""Designs for all wishes, as a table: measure.py PROGRAM [WISH...]

Each design's own card, and each of its kit's files, are checked: the exit code of `misalign card`, and that the kit is there.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]


def seconds_of_children():
    return sum(os.times()[2:4])


def measured(program, wish):
    with tempfile.TemporaryDirectory() as folder:
        begun, used = time.monotonic(), seconds_of_children()
        ended = subprocess.run([program, "design", wish, "--output", folder, "--json"], capture_output=True, text=True)
        seconds, cpu_s = time.monotonic() - begun, seconds_of_children() - used
        if ended.returncode not in (0, 6):
            sys.exit(f"{wish}: {ended.stderr}")
        lines = ended.stdout
        made = json.loads(lines[lines.index("{"):])
        card = subprocess.run([program, "card", f"{folder}/best.json", "--no-remedies"], capture_output=True, text=True)
        assert card.returncode == ended.returncode, (wish, card.returncode, ended.returncode)
        kit = any(name.startswith("best-kit") for name in os.listdir(folder))
    best = made["tries"][0]
    lacks = "; ".join(best["lacks"]) or f"{100 * best['score']:.0f} %, {best['decides_words'].split(',')[0]}"
    passing = sum(tried["passes"] for tried in made["tries"])
    return [f"`{wish.stem}`", "yes" if best["passes"] else "no", best["how"], best["chosen"], lacks,
            f"{passing} of {len(made['tries'])}", "yes" if kit else "no", f"{seconds:.0f}", f"{cpu_s:.0f}"]


def main():
    program, *names = sys.argv[1:]
    wishes = sorted(map(pathlib.Path, names) if names else (ROOT / "search/wishes").glob("*.json"))
    print("| wish | passes | sheet | chosen | least reserve, or what it lacks | passing tries | kit | s | CPU s |")
    print("|---|---|---|---|---|---|---|---|---|")
    for wish in wishes:
        print("| " + " | ".join(measured(program, wish)) + " |", flush=True)


if __name__ == "__main__":
    main()
