#!/usr/bin/env python3
"""Gives every option of every verb hostile values, and says what crashed, hung, leaked or was taken wrongly.

    tests/stress/option_values.py PROGRAM [CALLS [SEED]]

So many calls (3000), each of a verb with one of its options, as --help lists them, and a value that is no good,
or hardly: signs, exponents, other bases, infinities, NaN, control characters, other scripts, paths, lists. Each
call works in an empty folder beside a small catalogue, and may take 60 s and 2 GB. A call ends with a code of the
manual; a refusal is one sentence on standard error, without control characters, that names what to do; numbers
that are no decimal are never taken. The last line counts the calls by exit code.
"""

import random
import re
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

SECONDS, KILOBYTES = 60, 2_000_000
CODES = set(range(7))
VALUES = [
    "", " ", "0", "-0", "-1", "1", "2", "3.5", "1e3", "1e308", "1e999", "-1e999", "1e-320", "0x10", "0b11", "010",
    "1_000", "1,5", "1.5.2", "+5", "5 ", " 5", "5x", "nan", "-nan", "inf", "-inf", "NaN(1)", "18446744073709551616",
    "-9223372036854775809", "4294967297", "99999999999999999999999", "1e-9", "0.5", "90", "180", "180.0000001", "0:0",
    "5:1", "0:18446744073709551615", "a", "json", "all", "none", "null", "true", "[1]", "{}", "'", '"', "\\", ";",
    "1; DROP TABLE unit", "1) UNION SELECT 1 --", '"D" > 1', "D", "draw", "../x", "/", "/dev/null", "/dev/full", ".",
    "no/such/file", "small.db", "\x1b[2J", "a\nb", "\r", "\u202etxt", "\u6298\u308a\u7d19", "\U0001f9a2", "%s%n",
    "$(id)", "-", "--", "--help", "=", "A1-A2=5", "0,0", "0,0,-1", "1,2,3,4", "A" * 5000, "9" * 400,
]
NUMBERS = [value for value in VALUES if re.match(r"^[ +-]?[0-9.]", value)] + ["0.01", "7", "60", "1e-3", "100"]
NOT_DECIMAL = re.compile(r"^\s*[+-]?(0x|0b|nan|inf)", re.IGNORECASE)
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f\x80-\x9f\u200e\u200f\u2028-\u202e]")
SLOW = {"card", "deploy", "watch", "search", "stress", "bench", "optimise", "backlash", "tolerance", "certify", "verify", "doctor"}


def text(program, *words):
    return subprocess.run([program, *words], capture_output=True, text=True, check=True).stdout


def verbs_of(program):
    lines = text(program, "--help").split("\nVerbs:")[1].split("\n\n")[0]
    return re.findall(r"^  ([a-z]+)", lines, re.MULTILINE)


def options_of(program, verb):
    """The long name of each option that takes a value, with the value's name."""
    return re.findall(r"^  (?:-[a-z], )?(--[a-z-]+) (\S+)", text(program, verb, "--help"), re.MULTILINE)


class Calls:
    """What a verb needs beside the option, so that it comes to look at it."""

    def __init__(self, program, folder, source):
        self.program, self.folder = program, folder
        pattern = str(source / "search/patterns/table1.json")
        campaign = str(source / "search/campaigns/miura-4x4.json")
        catalogue = "small.db"
        subprocess.run(
            [program, "search", campaign, "--draws", "60", "--catalogue", catalogue, "--progress", "none"],
            cwd=folder, check=True, capture_output=True)
        self.arguments = {
            "search": [campaign, "--draws", "20", "--max-time", "5"], "config": ["--default"], "bench": [campaign],
            "fold": [pattern], "perforations": [pattern], "construct": [pattern], "actuators": [pattern],
            "deploy": [pattern], "contact": [pattern], "backlash": [pattern], "card": [pattern],
            "optimise": [pattern], "shape": [str(source / "search/patterns/dome-6x6.json")],
            "tolerance": [pattern], "certify": [pattern],
            "export": [catalogue, "--output", "out"], "report": [catalogue, "--output", "out.html"],
            "stress": [pattern, "--output", "out"], "query": [catalogue, "best"], "replay": [catalogue, "3"],
            "status": [catalogue], "verify": [catalogue, "--sample", "1"], "merge": ["joined.db", catalogue],
            "watch": [catalogue], "completion": ["bash"], "doctor": ["."], "help": [],
        }

    def run(self, verb, option, value):
        """The exit code, None after too long, and both outputs."""
        words = [word for word in self.arguments.get(verb, [])]
        if option in words:
            at = words.index(option)
            del words[at:at + 2]
        command = [self.program, verb, *words, option + "=" + value]
        limited = ["bash", "-c", f'ulimit -v {KILOBYTES}; exec timeout -s KILL {SECONDS} "$@"', "sh", *command]
        if verb in SLOW:  # what was taken works for long: a signal ends it
            limited = ["timeout", "-s", "TERM", "4", *limited]
        done = subprocess.run(limited, cwd=self.folder, capture_output=True, stdin=subprocess.DEVNULL)
        return done.returncode, done.stdout, done.stderr


def fault_of(verb, option, kind, value, code, out, err):
    said = err.decode("utf-8", "replace")
    if code in (124, 137) and verb not in SLOW:
        return "it hangs"
    if code in (-11, -6, -8, 134, 135, 136, 139) or "terminate called" in said or "Sanitizer" in said:
        return "it crashed"
    if code not in CODES and not (verb in SLOW and code in (124, 137, 143, -15)):
        return "an exit code of no meaning"
    if CONTROL.search(said.replace("\n", " ")):
        return "control characters on standard error"
    if any(word in said for word in ("std::", "basic_string", "json.exception", "what()")):
        return "an inner word is shown"
    if code == 0 and NOT_DECIMAL.match(value) and kind in ("N", "MM", "DEG", "S", "SECONDS", "SHARE", "NUMBER"):
        return "a number that is no decimal is taken"
    if code in (2, 3) and not re.search(r"misalign: .*", said):
        return "a refusal without a sentence"
    return None


def main():
    program = str(Path(sys.argv[1]).resolve())
    calls, seed = (int(word) for word in (sys.argv[2:] + ["3000", "1"][len(sys.argv) - 2:]))
    dice = random.Random(seed)
    source = Path(__file__).resolve().parents[2]
    pairs = [(verb, option, kind) for verb in verbs_of(program) for option, kind in options_of(program, verb)]
    codes, faults = Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        tried = Calls(program, folder, source)
        kept = (Path(folder) / "small.db").read_bytes()
        for number in range(calls):
            verb, option, kind = pairs[number % len(pairs)]
            value = dice.choice(NUMBERS if dice.random() < 0.5 else VALUES)
            code, out, err = tried.run(verb, option, value)
            codes[code] += 1
            fault = fault_of(verb, option, kind, value, code, out, err)
            if not fault and (Path(folder) / "small.db").read_bytes() != kept and verb not in ("search", "certify", "tolerance"):
                fault = "the catalogue was changed"
            (Path(folder) / "small.db").write_bytes(kept)
            if fault:
                faults += 1
                print(f"{fault}: misalign {verb} {option}={value[:60]!r} ends with {code}: {err[-300:]!r}", flush=True)
    print(f"seed {seed}: {calls} calls of {len(pairs)} options, {faults} faults; by exit code "
          + ", ".join(f"{code}: {count}" for code, count in sorted(codes.items())))
    return faults > 0


if __name__ == "__main__":
    sys.exit(main())
