#!/usr/bin/env python3
"""What the code of a tree measures, as a Markdown table with a column for each: house.py [TREE...]
house.py --check [TREE] fails, and says where, when a file or a function is too long or an include points to a
later room."""

import re
import statistics
import sys
from pathlib import Path

ROOMS = {"solver": "pattern kinematics linear continuation verdict model judging records lanes design certificate reference",
         "schema": "files campaign records catalogue exchange kit report",
         "search": "terminal draws splitting sheets ranks checks report watch verbs python"}  # in the order of dependence
PLACES = [(top, room) for top, rooms in ROOMS.items() for room in rooms.split()]
MOST_LINES, MOST_FUNCTION_LINES = 350, 70
NO_METRICS = {"draw", "unit", "deploys_from_sample", "displacements_mm", "elongation"}
FAULTS = ("fold_limit over_folded assignment_flipped not_monotone reverses_between_samples bump_between_samples "
          "soft_stop inactive_diagonal").split()
# Ranges that are joined, cut or subtracted; and what a catalogue of an older schema lacks.
RANGE_ALGEBRA = r"std::(max|min)\([^()]*\b(range|taken|back\(\))\.hi\b|back\(\)\.hi\b"
SCHEMA_VERSIONS = r"\bk\w+Since\b|\bkSchemaVersion\b|\bkLaterColumns\b"

# Comments, and texts, which may hold what looks like a comment or a brace.
COMMENT_OR_TEXT = r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"""
CPP_NOISE = r"""R"(\w*)\(.*?\)\1"|""" + COMMENT_OR_TEXT
JS_NOISE = (COMMENT_OR_TEXT + r"|`(?:\\.|[^`\\])*`"
            r"|(?:(?<=[(=,:!&|?\[>])|(?<=return))\s*/(?![/*])(?:\\.|\[(?:\\.|[^\]\\])*\]|[^/\\\n])+/")
NOISE = {".cpp": CPP_NOISE, ".hpp": CPP_NOISE, ".js": JS_NOISE, ".sql": r"--[^\n]*"}
# What stands before a function's or a type's brace.
CONTROL = r"(case\b[^?]*:|default\s*:)?\s*(else\s+)?(if|for|while|switch|catch)\b"
CPP_FUNCTION = r"\)\s*(const|noexcept|override|final|mutable|->[^()=]+|\s)*(:[^:].*)?$"
FUNCTION = {".cpp": CPP_FUNCTION, ".hpp": CPP_FUNCTION, ".js": r"(=>|\))\s*$"}
NAMED_TYPE = r"\b(class|struct|enum(\s+class)?)\s+(\w+\s+)*?(\w+)\s*(final\s*)?(:[^()]*)?$"


def files_of(tree, top, *endings):
    paths = sorted((tree / top).rglob("*"))
    return [path for path in paths if path.suffix in endings and "node_modules" not in path.parts]


def code_of(tree):
    return [path for top in ROOMS for path in files_of(tree, top, ".cpp", ".hpp", ".js")]


def bare(path):
    """A file without texts and comments, its lines where they were."""
    def left(match):
        return ("" if match[0].startswith(("//", "/*", "--")) else '""') + "\n" * match[0].count("\n")
    return re.sub(NOISE[path.suffix], left, path.read_text(), flags=re.S)


def blocks_of(path):
    """Every pair of braces: what stands before it, its first and last line, and what is round it."""
    text = bare(path) if path.suffix == ".js" else re.sub(r"^\s*#[^\n]*", "", bare(path), flags=re.M)
    head, depth, line, first, around = "", 0, 1, 1, []
    for at in text:
        if at == "{":
            around.append((head.strip(), first, depth))
            head, depth = "", 0
        elif at == "}" and around:
            before, begin, depth = around.pop()
            yield before, begin, line, [outer[0] for outer in around]
            head = ""
        elif depth == 0 and (at == ";" or at == "," and path.suffix == ".js"):
            head = ""
        elif head or not at.isspace():
            depth += (at in "([") - (at in ")]")
            first = first if head else line
            head += at
        line += at == "\n"


def long_functions(path):
    for head, first, last, _ in blocks_of(path):
        is_function = re.search(FUNCTION[path.suffix], head, re.S) and not re.match(CONTROL, head)
        if is_function and last - first >= MOST_FUNCTION_LINES:
            yield first, last - first + 1


def public_types(path):
    """Types in no other type, and in no namespace that is anonymous or called detail."""
    return [head for head, _, _, around in blocks_of(path) if re.search(NAMED_TYPE, head, re.S) and
            all(re.match(r"namespace\s+(?!\S*detail)\w", outer) for outer in around)]


def includes(tree):
    return [(path.relative_to(tree), Path(include)) for path in code_of(tree)
            for include in re.findall(r'^#include "((?:solver|schema|search)/[^"]+)"', path.read_text(), re.M)]


def upward(tree):
    for source, target in includes(tree):
        here, there = source.parts[:2], target.parts[:2]
        if here in PLACES and there in PLACES[PLACES.index(here) + 1:]:
            yield f"{source} includes {target}, which is in a later room"


def circles(tree):
    """How many groups of nouns (a header with its source) include each other, directly or not."""
    reach = {}
    for source, target in includes(tree):
        reach.setdefault(source.with_suffix(""), set()).add(target.with_suffix(""))
    for middle in list(reach):
        for others in reach.values():
            others |= reach[middle] if middle in others else set()
    return sum(len(group) > 1 for group in {frozenset(b for b in reach[a] if a in reach.get(b, ())) for a in reach})


def named_in(texts, names):
    counts = sorted(sum(bool(re.search(rf"\b{name}\b", text)) for text in texts) for name in names)
    return f"{statistics.median(counts):g} ({counts[0]} to {counts[-1]})"


def measures(tree):
    code = code_of(tree)
    texts = [path.read_text() for path in code + files_of(tree, "schema", ".json")]
    table = re.search(r"CREATE TABLE candidate \((.*?)\n\)", (tree / "schema/catalogue.sql").read_text(), re.S)
    metrics = set(re.findall(r"^  ([a-z]\w+) (?:INTEGER|REAL|TEXT)", table[1], re.M)) - NO_METRICS
    for name, top, endings in (("solver", "solver", (".cpp", ".hpp")), ("search", "search", (".cpp", ".hpp")),
                               ("schema (C++, SQL)", "schema", (".cpp", ".hpp", ".sql")),
                               ("page (JavaScript)", "schema", (".js",))):
        yield f"lines of code: {name}", sum(
            bool(line.strip()) for path in files_of(tree, top, *endings) for line in bare(path).splitlines())
    yield "public types in headers: solver", sum(len(public_types(p)) for p in files_of(tree, "solver", ".hpp"))
    yield f"functions over {MOST_FUNCTION_LINES} lines", sum(len(list(long_functions(path))) for path in code)
    yield f"files over {MOST_LINES} lines", sum(len(path.read_text().splitlines()) > MOST_LINES for path in code)
    has_rooms = tree.joinpath(*PLACES[0]).is_dir()
    yield "includes of a later room", len(list(upward(tree))) if has_rooms else "no rooms"
    yield "circles of includes", circles(tree)
    yield "files that name a metric: median (least to most)", named_in(texts, metrics)
    yield "files that name a fault: median (least to most)", named_in(texts, FAULTS)
    for name, words in (("do algebra of ranges", RANGE_ALGEBRA), ("know a schema version", SCHEMA_VERSIONS)):
        yield f"files that {name}", sum(bool(re.search(words, text)) for text in texts)


def complaints(tree):
    yield from upward(tree)
    for path in code_of(tree):
        if (lines := len(path.read_text().splitlines())) > MOST_LINES:
            yield f"{path.relative_to(tree)}: {lines} lines (at most {MOST_LINES}); it may hold a second noun"
        for first, length in long_functions(path):
            yield f"{path.relative_to(tree)}:{first}: a function of {length} lines (at most {MOST_FUNCTION_LINES})"


trees = [Path(name) for name in sys.argv[1:] if name != "--check"] or [Path(__file__).parent.parent]
if "--check" in sys.argv:
    sys.exit("\n".join(complaints(trees[0])) or 0)
print("| |", " | ".join(tree.resolve().name for tree in trees), "|\n|---|" + "---|" * len(trees))
for row in zip(*map(measures, trees)):
    print("|", row[0][0], "|", " | ".join(str(value) for _, value in row), "|")
