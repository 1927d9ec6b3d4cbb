#!/usr/bin/env python3
"""Can the simulation fail? Errors are put into the program one at a time, and stories played until one fails.

mutations.py TREE SEEDS [NAME...]: TREE is a copy of the sources (git worktree add TREE) that is changed and built in
TREE/build/release. A line for each: after which seed it was caught, by what. Mends are undone for the scenarios.
The program as it is must pass both before.
"""
import pathlib
import re
import subprocess
import sys

CATALOGUE = "schema/catalogue/"
MUTATIONS = {
    "no sync before the acknowledgement": (CATALOGUE + "database.cpp", "synchronous = FULL", "synchronous = NORMAL"),
    "synchronous=OFF": (CATALOGUE + "database.cpp", "synchronous = FULL", "synchronous = OFF"),
    "ledger row in another transaction": (
        CATALOGUE + "unit_writer.cpp", "  for (const Candidate& candidate : unit.candidates) write_candidate(candidate, lo);",
        '  database_.exec("COMMIT");\n  database_.exec("BEGIN IMMEDIATE");\n'
        "  for (const Candidate& candidate : unit.candidates) write_candidate(candidate, lo);"),
    "lock taken with the first commit": (
        CATALOGUE + "writer_lock.cpp", "    check_kind();\n    lock();", "    check_kind();",
        CATALOGUE + "writer_lock.hpp", "  void check_kind() const;\n", "  void check_kind() const;\n public:\n",
        CATALOGUE + "catalogue.cpp", "    GoalEnd end = *goal_end_;\n", "    lock_.lock();\n    GoalEnd end = *goal_end_;\n"),
    "certificate dropped on renumbering": (
        CATALOGUE + "sheets_once.cpp", "    hand_on_certificate(database, campaign, mechanism, draw, least);",
        "    (void)campaign, (void)mechanism;"),
    "merge forgets an overlap": (
        "search/checks/merge.cpp", "    for (const DrawRange& range : plan_.recomputed) {",
        "    if (!plan_.recomputed.empty()) plan_.recomputed.pop_back();\n"
        "    for (const DrawRange& range : plan_.recomputed) {"),
    "range given out twice": (
        "search/draws/ledger.cpp", "  given_out_.insert(taken.lo);\n  return taken;",
        "  given_out_.insert(taken.lo);\n  if (taken.lo % 5 == 3) open(taken);\n  return taken;"),
    "message applied twice": (
        "search/ranks/draw_task.cpp", "  waiting_.push_back(std::move(unit));",
        "  if (unit.worker > 0) waiting_.push_back(unit);\n  waiting_.push_back(std::move(unit));"),
    "stop skips the last commit": (
        "search/ranks/coordinator.cpp", "    task_.hand_in_own();\n    task_.commit();\n", "",
        "search/ranks/coordinator.cpp", "    task_.commit_all();\n    progress_", "    if (!stop) task_.commit_all();\n    progress_"),
    "migration without its transaction": (
        CATALOGUE + "catalogue_opening.cpp", "  SQLite::Transaction transaction(*database_);\n  for (int next", "  for (int next",
        CATALOGUE + "catalogue_opening.cpp", '/" + std::to_string(next) + ".sql"));\n  }\n  transaction.commit();\n',
        '/" + std::to_string(next) + ".sql"));\n  }\n'),
}
MENDS = {
    "log not written again": (CATALOGUE + "write_ahead_log.cpp", "  if (journal_bytes(leftover) == 0) return;\n", "  if (!leftover.empty()) return;\n"),
    "removed journal not synced": (CATALOGUE + "write_ahead_log.cpp", "would bring it back.\n  sync_directory_of(path);\n", "would bring it back.\n"),
    "lost log not checked": (CATALOGUE + "catalogue_opening.cpp", "if (lacks_log_) expect", "if (false) expect"),
    "unreadable input called missing": ("schema/files/file_bytes.cpp", "ENAMETOOLONG, ENXIO}", "ENAMETOOLONG, EIO}"),
}


def run(tree: pathlib.Path, *words: str) -> str:
    program = tree / "build/release/tests/simulate"
    return subprocess.run([program, *words], capture_output=True, text=True, check=False).stdout


def changed(tree: pathlib.Path, edits: tuple[str, ...]) -> dict[pathlib.Path, str]:
    """Makes the edits; returns the files as they were."""
    before = {}
    for name, old, new in zip(edits[::3], edits[1::3], edits[2::3]):
        path = tree / name
        text = path.read_text()
        before.setdefault(path, text)
        if text.count(old) != 1:
            sys.exit(f"{name} has {text.count(old)} places like {old!r}")
        path.write_text(text.replace(old, new))
    return before


def build(tree: pathlib.Path) -> str:
    """Builds the program; returns the compiler's words if it cannot be built."""
    built = subprocess.run(["ninja", "-C", tree / "build/release", "simulate"], capture_output=True, text=True, check=False)
    return "" if built.returncode == 0 else "does not compile: " + built.stdout[-1500:]


def caught(tree: pathlib.Path, name: str, seeds: str) -> str:
    """What has found the error; empty if nothing has."""
    if words := build(tree):
        sys.exit(f"{name}: {words}")
    if name in MENDS:
        failures = run(tree, "--scenarios").splitlines()
        return f"{len(failures)} scenarios fail: {failures[0]}" if failures else ""
    found = re.search(r"seed (\d+): (.*)", text := run(tree, "0", seeds, "2", "1"))
    return f"caught by seed {found[1]} of {text.split(' seeds')[0].split()[-1]}: {found[2]}" if found else ""


def main() -> None:
    tree, seeds = pathlib.Path(sys.argv[1]), sys.argv[2]
    if words := build(tree) or run(tree, "--scenarios") or re.search(r"seed \d+: .*", run(tree, "0", "300", "2", "1")):
        sys.exit(f"the program as it is fails: {words}")
    missed = 0
    for name, edits in (MUTATIONS | MENDS).items():
        if sys.argv[3:] and name not in sys.argv[3:]:
            continue
        before = changed(tree, edits)
        try:
            answer = caught(tree, name, seeds)
        finally:
            for path, text in before.items():
                path.write_text(text)
        print(f"{name}: {answer[:300] or 'NOT CAUGHT'}", flush=True)
        missed += not answer
    sys.exit(missed)


if __name__ == "__main__":
    main()
