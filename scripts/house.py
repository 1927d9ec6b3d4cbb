#!/usr/bin/env python3
"""Counts what linters cannot of a tree's code, as a Markdown table with a column for each: house.py [TREE...]
house.py --check [TREE] fails, and says where, when a file is too long, an include points to a later room, or a number
of scripts/house.json is worse than it stands there. house.py --write [TREE] writes the better ones into that file."""

import json
import re
import statistics
import sys
from itertools import chain
from pathlib import Path

import words

ROOMS = {"solver": "pattern kinematics fill linear continuation verdict model judging records lanes sheet target studies contact motion bending play fitting optimise shape certificate reference",
         "schema": "files surface pattern campaign records catalogue memory exchange nesting kit print report",
         "search": "terminal draws splitting sheets ranks checks report watch verbs python"}  # in the order of dependence
PLACES = [(top, room) for top, rooms in ROOMS.items() for room in rooms.split()]
MOST_LINES, MOST_NOUNS, MOST_LINES_OF_FUNCTION = 350, 20, 70
DRAW = "search/draws/draw_evaluator.cpp"
MAY_RISE = "`assert`"  # the other numbers that are held may fall
NO_METRICS = {"draw", "unit", "deploys_from_sample", "displacements_mm", "elongation"}
FAULTS = ("fold_limit over_folded assignment_flipped not_monotone reverses_between_samples bump_between_samples "
          "soft_stop inactive_diagonal energy_rises weak_drive off_shape").split()
# Ranges that are joined, cut or subtracted; and what a catalogue of an older schema lacks.
RANGE_ALGEBRA = r"std::(max|min)\([^()]*\b(range|taken|back\(\))\.hi\b|back\(\)\.hi\b"
SCHEMA_VERSIONS = r"\bk\w+Since\b|\bkSchemaVersion\b|\bkLaterColumns\b"
# As clang-format leaves them; in no other type and in a namespace, where they begin a line.
TYPE = r"(?:class|struct|union|enum(?: class| struct)?) (?:\w+ )*?(\w+)(?: final)?(?: ?:[^;{}()]*)? ?\{"
PUBLIC_TYPE = re.compile(rf"^{TYPE}", re.M)
ANY_TYPE = re.compile(rf"^ *{TYPE}", re.M)
# Functions of a namespace or a class, and those that JavaScript calls function: the line that names one to its closing
# brace, which is as far from the margin.
CPP_FUNCTION = re.compile(r"^(|  )(?!namespace|class|struct|union|enum|if|for|while|switch|else|do\b|try)"
                          r"[^\s{};:/][^{};\n]*\([^{};]*\{\n(.*?)^\1\}", re.M | re.S)
JS_FUNCTION = re.compile(r"^( *)(?:export )?(?:default )?(?:async )?function\b[^;]*?\{\n(.*?)^\1\}", re.M | re.S)
SKIPPED_NAMESPACE = re.compile(r"^namespace(?: detail)? \{\n.*?^\}  // namespace(?: detail)?$", re.M | re.S)


def files_of(tree, top, *endings):
    paths = sorted((tree / top).rglob("*"))
    return [path for path in paths if path.suffix in endings and "node_modules" not in path.parts]


def cpp_of(tree, *tops):
    return [path for top in tops or ROOMS for path in files_of(tree, top, ".cpp", ".hpp")]


def code_of(tree):
    return cpp_of(tree) + [path for top in ROOMS for path in files_of(tree, top, ".js")]


def lines(paths):
    return sum(len(path.read_text().splitlines()) for path in paths)


def types(paths, pattern):
    """Their names, without those of anonymous namespaces and of one called detail where only public ones count."""
    for path in paths:
        text = path.read_text()
        yield from pattern.findall(SKIPPED_NAMESPACE.sub("", text) if pattern is PUBLIC_TYPE else text)


def named_elsewhere(tree):
    """Of each public type of the solver, whether a file of another room or layer names it."""
    words = {path: set(re.findall(r"\w+", path.read_text())) for path in cpp_of(tree)}
    for path in files_of(tree, "solver", ".hpp"):
        others = [named for other, named in words.items() if other.parent != path.parent]
        for name in types([path], PUBLIC_TYPE):
            yield any(name in named for named in others)


def nouns(tree):
    """Headers with their sources: the place of each, without its ending, and their files."""
    found = {}
    for path in cpp_of(tree):
        found.setdefault(path.relative_to(tree).with_suffix(""), []).append(path)
    return found


def includes(path):
    return map(Path, re.findall(r'^#include "((?:solver|schema|search)/[^"]+)"', path.read_text(), re.M))


def upward(tree):
    for path in cpp_of(tree):
        source = path.relative_to(tree)
        for target in includes(path):
            here, there = source.parts[:2], target.parts[:2]
            if here in PLACES and there in PLACES[PLACES.index(here) + 1:]:
                yield f"{source} includes {target}, which is in a later room"


def circles(tree):
    """How many groups of nouns include each other, directly or not."""
    reach = {noun: {target.with_suffix("") for path in paths for target in includes(path)} - {noun}
             for noun, paths in nouns(tree).items()}
    for middle in reach:
        for others in reach.values():
            others |= reach[middle] if middle in others else set()
    groups = {frozenset(b for b in reach[a] if a in reach.get(b, ())) for a in reach}
    return sum(len(group) > 1 for group in groups)


def reached(tree, start):
    """The files that one needs: what it includes, the sources of those headers, what these include, and so forth."""
    found, waiting = set(), [tree / start]
    while waiting:
        path = waiting.pop()
        if path in found or not path.exists():
            continue
        found.add(path)
        waiting += [tree / target for target in includes(path)] + [path.with_suffix(".cpp")]
    return found


def large_rooms(tree):
    rooms = [noun.parts[:2] for noun in nouns(tree) if len(noun.parts) == 3]
    return sorted("/".join(room) for room in set(rooms) if rooms.count(room) > MOST_NOUNS)


def long_functions(tree):
    for path in code_of(tree):
        for _, body in (JS_FUNCTION if path.suffix == ".js" else CPP_FUNCTION).findall(path.read_text()):
            if body.count("\n") >= MOST_LINES_OF_FUNCTION:
                yield path


def named_in(texts, names):
    counts = sorted(sum(bool(re.search(rf"\b{name}\b", text)) for text in texts) for name in names)
    return f"{statistics.median(counts):g} ({counts[0]} to {counts[-1]})"


def held(tree):
    """What may not become worse than in scripts/house.json."""
    yield "lines of C++", lines(cpp_of(tree))
    yield "public types: solver", len(list(types(files_of(tree, "solver", ".hpp"), PUBLIC_TYPE)))
    yield f"nouns over {MOST_LINES} lines", sum(lines(paths) > MOST_LINES for paths in nouns(tree).values())
    yield f"rooms with more than {MOST_NOUNS} nouns", len(large_rooms(tree))
    yield "circles of includes", circles(tree)
    yield f"files that `{Path(DRAW).name}` reaches by includes", len(reached(tree, DRAW))
    yield f"functions over {MOST_LINES_OF_FUNCTION} lines", len(list(long_functions(tree)))
    yield MAY_RISE, sum(len(re.findall(r"\bassert\(", path.read_text())) for path in cpp_of(tree))


def better(name, value, other):
    return value > other if name == MAY_RISE else value < other


def measures(tree):
    code = code_of(tree)
    texts = [path.read_text() for path in code + files_of(tree, "schema", ".json")]
    table = re.search(r"CREATE TABLE candidate \((.*?)\n\)", (tree / "schema/catalogue.sql").read_text(), re.S)
    metrics = set(re.findall(r"^  ([a-z]\w+) (?:INTEGER|REAL|TEXT)", table[1], re.M)) - NO_METRICS
    for top in ROOMS:
        yield f"lines of C++: {top}", lines(cpp_of(tree, top))
    yield "lines of JavaScript: the page", lines(files_of(tree, "schema", ".js"))
    yield "lines of all of these", lines(code)
    yield from held(tree)
    yield "public types named outside their room: solver", sum(named_elsewhere(tree))
    yield "types with Sheet in their name", len({name for name in types(cpp_of(tree), ANY_TYPE) if "Sheet" in name})
    yield "nouns (header and source)", len(nouns(tree))
    yield "large rooms", ", ".join(large_rooms(tree)) or "none"
    has_rooms = tree.joinpath(*PLACES[0]).is_dir()
    yield "includes of a later room", len(list(upward(tree))) if has_rooms else "no rooms"
    yield "lines of the files that a draw reaches", lines(reached(tree, DRAW))
    yield "files that name a metric: median (least to most)", named_in(texts, metrics)
    yield "files that name a fault: median (least to most)", named_in(texts, FAULTS)
    for name, pattern in (("do algebra of ranges", RANGE_ALGEBRA), ("know a schema version", SCHEMA_VERSIONS)):
        yield f"files that {name}", sum(bool(re.search(pattern, text)) for text in texts)


def complaints(tree):
    yield from upward(tree)
    for path in code_of(tree):
        if (count := lines([path])) > MOST_LINES:
            yield f"{path.relative_to(tree)}: {count} lines (at most {MOST_LINES}); it may hold a second noun"
    limits = json.loads((tree / "scripts/house.json").read_text())
    for name, value in chain(held(tree), words.held()):
        if better(name, limits[name], value):
            yield (f"{name}: {value}, and {limits[name]} in scripts/house.json; bring it back, or change the number "
                   "there in a commit that says why")
        elif better(name, value, limits[name]):
            print(f"{name}: {value}, better than the {limits[name]} in scripts/house.json; scripts/house.py --write keeps it")


def write(tree):
    path = tree / "scripts/house.json"
    limits = json.loads(path.read_text()) if path.exists() else {}
    for name, value in chain(held(tree), words.held()):
        if name not in limits or better(name, value, limits[name]):
            limits[name] = value
    path.write_text(json.dumps(limits, indent=2) + "\n")


trees = [Path(name) for name in sys.argv[1:] if not name.startswith("--")] or [Path(__file__).parent.parent]
if "--check" in sys.argv:
    sys.exit("\n".join(complaints(trees[0])) or 0)
if "--write" in sys.argv:
    sys.exit(write(trees[0]))
print("| |", " | ".join(tree.resolve().name for tree in trees), "|\n|---|" + "---|" * len(trees))
for row in zip(*map(measures, trees)):
    print("|", row[0][0], "|", " | ".join(str(value) for _, value in row), "|")
