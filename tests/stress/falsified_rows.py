#!/usr/bin/env python3
"""Falsifies one cell or row of real catalogues at a time, and says what a verb took that is wrong.

    tests/stress/falsified_rows.py PROGRAM [WORD...]

PROGRAM makes four small catalogues: draws, some certified and with yields; populations; draws that are optimised;
populations under way, in pieces. Every cell of a row in the middle of each table is falsified in turn (none, another
type, the next number, a thousandth more, negated, huge, a bit, a letter, control characters), then rows, views,
triggers and keys of the campaign are; only kinds whose name has a WORD, if there are any. verify --all --units, status,
query, merge with the other half and a search that goes on are asked about each. They may take 60 s, end with a code of
the manual and print no control characters on standard error. What verify calls good shows the same answers and leads
merge and search to the same digest as the honest catalogue, unless ADVICE or OWN says why it may pass.
"""

import math
import os
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SECONDS, WORKERS = 60, 3
CODES = {0, 1, 2, 3, 4, 5, 6, 75}
CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f\x80-\x9f\u200e\u200f\u2028-\u202e]")
SHEET = '"pattern": {"family": "miura", "rows": 4, "columns": 4}, "accept": {"deploys_from_deg": '
# Of each catalogue: its campaign, the unit of --draws or --populations, of how many it is, what a search that goes on
# adds, and options.
CATALOGUES = {
    "plain": (SHEET + "174}", "draws", 2100, 60, ["--unit-draws", "300"]),
    "split": (SHEET + '178}, "search": {"method": "splitting", "particles": 20, "sweeps": 2, "first_draws": 400}',
              "populations", 3, 1, []),
    "better": (SHEET + '150}, "search": {"method": "optimise", "from_deg": 36, "subject_to": ["stroke_max <= 0.06"]}',
               "draws", 8, 2, ["--unit-draws", "4"]),
    "pieces": (SHEET + '178}, "search": {"method": "splitting", "particles": 300, "sweeps": 2, "first_draws": 60000}',
               "populations", 1, 0, []),
}
QUERIES = ["SELECT * FROM candidates", "acceptance", "rejections",
           "SELECT json_array(draw, vertex, dx_mm, dy_mm) FROM displacements "
           "UNION ALL SELECT json_array(draw, elongation, from_vertex, to_vertex) FROM diagonals "
           "UNION ALL SELECT json_array(draw, starts, steps, ended, limited_by) FROM ends "
           "UNION ALL SELECT json_array(draw, from_deg, trials, survivors, undecided, share, share_high) FROM yields"]
ROUNDING = "within the tolerance by which builds may differ"
GOAL = "what was asked of the last run; goal_end is checked to follow from it"
# Columns that nobody can know afterwards, by what they say (schema/SAFETY.md); no verdict or digest depends on them.
ADVICE = {
    "campaign.name": "a label", "campaign.range_lo": GOAL, "campaign.range_hi": GOAL, "campaign.goal_draws": GOAL,
    "campaign.goal_accepted": GOAL, "campaign.goal_relative_error": GOAL, "run.host": "a label", "run.version": "a note of the build",
    "run.commit": "a note of the build", "run.compiler": "a note of the build", "run.flags": "a note of the build",
    "run.started_at": "when, if it is a time", "run.ended_at": "when, if it is a time",
    "run.end": "a note of why", "run.commit_s": "a time taken", "run.longest_commit_s": "a time taken",
    "run.commits": "a count of commits, at most of units", "run.tables_deg": "a note of the machine",
    "run.golden_verdicts": "of the build; compared when a search goes on or catalogues are joined",
    "run.metrics_version": "by which definitions candidates are compared",
    "run.ranks": "a count, above every worker", "unit.run": "who did it", "unit.worker": "who did it", "unit.seconds": "a time taken",
    "screened.cause": "by the build's tests", "screened.tested_deg": "by the build's tests",
    "population.seconds": "a time taken", "certificate.seconds": "a time taken",
    "undecided.cause": "by the build's tests", "candidate.residual_max": ROUNDING, "candidate.isometry_error_mm": ROUNDING,
    "yield.commit": "a note of the build", "yield.made_at": "when",
    "yield.amplitude_mm": "of trials, which `misalign tolerance` makes again",
    "yield.from_deg": "of trials, which `misalign tolerance` makes again",
}


def quoted(column):
    return '"' + column + '"'


def lies_about(table, column, kind, is_filled, is_first):
    """Names of lies about a cell of that declared type, and the SQL of the false value.

    What SQLite itself knows is tried once for each type of a table: another type, and no value where it must have one."""
    cell = quoted(column)
    if kind == "REAL":
        lies = {"a bit more": f"next({cell})", "a thousandth more": f"{cell} * 1.001 + 1e-300", "negated": f"-{cell}",
                "huge": "1e308", "infinite": "9e999"}
    elif kind == "INTEGER":
        lies = {"one more": f"{cell} + 1", "one less": f"{cell} - 1", "negative": "-7", "huge": "1 << 62"}
    elif kind == "TEXT":
        lies = {"empty": "''", "a letter": f"letter({cell})", "controls": f"{cell} || char(27) || '[2J' || char(155)"}
    else:
        lies = {"a bit": f"bit({cell})", "the last bit": f"lastbit({cell})", "shorter": f"substr({cell}, 2)", "empty": "x''"}
    if is_first or not is_filled:
        lies["none"] = "NULL"
    if is_first:
        lies |= {"another type": "x'fe00ff'", "long": f"{cell} || hex(zeroblob(100000))"} if kind == "TEXT" else {"another type": "'x'"}
    return {f"{table}.{column}: {lie}": f"UPDATE {table} SET {cell} = {value}" for lie, value in lies.items()}


def key_of(table, column, path, value):
    return f"UPDATE {table} SET {column} = json_set({column}, '{path}', {value})"


SWAP = ("UPDATE {table} SET {column} = (SELECT {column} FROM {table} WHERE draw = (SELECT max(draw) FROM {table})) "
        "WHERE draw = (SELECT min(draw) FROM {table})")
EVERY = {  # of every catalogue: no `WHERE` is added
    "application_id": "PRAGMA application_id = 1", "version of the future": "PRAGMA user_version = 99",
    "version of the past": "PRAGMA user_version = 3", "no version": "PRAGMA user_version = 0",
    "a trigger more": "CREATE TRIGGER spy AFTER INSERT ON unit BEGIN DELETE FROM unit; END",
    "a trigger less": "DROP TRIGGER unit_overlaps",
    "a view of another kind": "DROP VIEW acceptance; CREATE VIEW acceptance AS SELECT 1 AS draws",
    "a view more": "CREATE VIEW spy AS SELECT * FROM unit", "an index less": "DROP INDEX candidate_best",
    "a table more": "CREATE TABLE spy (x)", "a column more": "ALTER TABLE run ADD COLUMN spy TEXT",
    "no campaign": "DELETE FROM campaign", "no runs": "DELETE FROM run", "no units": "DELETE FROM unit",
    "no row of screened": "DELETE FROM screened", "no row of fault_sample": "DELETE FROM fault_sample",
    "no levels": "DELETE FROM level", "no populations": "DELETE FROM population", "no sheets": "DELETE FROM sheet",
    "no ascents": "DELETE FROM ascent", "no candidates": "DELETE FROM candidate",
    "a candidate less": "DELETE FROM candidate WHERE draw = (SELECT max(draw) FROM candidate)",
    "a unit less": "DELETE FROM unit WHERE lo = (SELECT max(lo) FROM unit)",
    "a unit more": "INSERT INTO unit SELECT hi, 2 * hi - lo, run, worker, 0, hi - lo, 0, seconds, zeroblob(16) FROM unit "
                   "WHERE lo = (SELECT max(lo) FROM unit)",
    "a unit that goes back": "UPDATE unit SET lo = lo - 1, rejected = rejected + 1 WHERE lo = (SELECT max(lo) FROM unit)",
    "seed": key_of("campaign", "configuration", "$.seed", 2),
    "threshold": key_of("campaign", "configuration", "$.accept.deploys_from_deg", 170),
    "pattern": key_of("campaign", "configuration", "$.pattern.panel_width_mm", 81),
    "amplitude": key_of("campaign", "configuration", "$.misalignment.amplitude_mm", "'x'"),
    "key of no campaign": key_of("campaign", "configuration", "$.nonsense", 1),
    "a stiffness": key_of("campaign", "configuration", "$.design", "json('{\"springs\": {\"stiffness_n_per_mm\": 70}}')"),
    "wall time": key_of("campaign", "configuration", "$.stop", "json('{\"wall_s\": 70}')"),
    "run's seed": key_of("run", "configuration", "$.seed", 2),
    "deep JSON": "UPDATE campaign SET configuration = printf('%.*c', 50000, '[') || printf('%.*c', 50000, ']')",
    "a diagonal's length": key_of("campaign", "diagonals", "$[0].flat_mm", 99.5),
    "a diagonal's vertex": key_of("campaign", "diagonals", "$[0].from", "'A1'"),
    "shifts swapped": SWAP.format(table="candidate", column="displacements_mm"),
    "D swapped": SWAP.format(table="candidate", column="deploys_from_sample"),
    "elongations swapped": SWAP.format(table="candidate", column="elongation"),
    "a shift turned": "UPDATE candidate SET displacements_mm = replace(displacements_mm, '0.4', '-0.4')",
    "a vertex more": key_of("candidate", "displacements_mm", "$.Z99", "json('[0.4, 0]')"),
    "a vertex less": "UPDATE candidate SET displacements_mm = '{}'",
    "a shift that is huge": key_of("candidate", "displacements_mm", "$.A8", "json('[1e300, 0]')"),
    "a shift of text": key_of("candidate", "displacements_mm", "$.A8", "json('[\"x\", null]')"),
    "an elongation": key_of("candidate", "elongation", "$[0]", 0.5),
    "an elongation of text": key_of("candidate", "elongation", "$[1]", "'x'"),
    "an elongation more": key_of("candidate", "elongation", "$[#]", 0.5),
    "a draw both accepted and undecided": "INSERT INTO undecided SELECT draw, unit, 'dense', 1 FROM candidate LIMIT 1",
    "an undecided draw more": "INSERT INTO undecided SELECT lo, lo, 'dense', 1 FROM unit LIMIT 1",
}
# A unit of one candidate loses it with its sums: zero is what is left of them.
EMPTIED = "(SELECT min(lo) FROM unit WHERE accepted = 1)"
OF_PLAIN = {
    "removed with its sums": f"CREATE TEMP TABLE one AS SELECT {EMPTIED} AS lo; DELETE FROM certificate WHERE draw IN "
    "(SELECT draw FROM candidate JOIN one ON unit = lo); DELETE FROM yield WHERE draw IN (SELECT draw FROM candidate "
    "JOIN one ON unit = lo); DELETE FROM candidate WHERE unit = (SELECT lo FROM one); UPDATE unit SET accepted = 0, "
    "rejected = rejected + 1, digest_part = zeroblob(16) WHERE lo = (SELECT lo FROM one); UPDATE screened SET "
    "draws = draws + 1 WHERE (cause, tested_deg) = (SELECT cause, tested_deg FROM screened LIMIT 1)",
    "a rejected draw left undecided": "CREATE TEMP TABLE one AS SELECT lo FROM unit LIMIT 1 OFFSET 3; INSERT INTO undecided "
    "SELECT lo + 5, lo, 'dense', 1 FROM one; UPDATE unit SET undecided = 1, rejected = rejected - 1 WHERE lo = (SELECT lo "
    "FROM one); UPDATE screened SET draws = draws - 1 WHERE (cause, tested_deg) = (SELECT cause, tested_deg FROM screened "
    "WHERE draws > 1 LIMIT 1)",
    "causes shared out otherwise": "UPDATE screened SET draws = draws - 1 WHERE tested_deg = 160.0; UPDATE screened SET "
    "draws = draws + 1 WHERE tested_deg = 161.0",
    "certificates swapped": SWAP.format(table="certificate", column="proof"),
    "a certificate of another draw": "UPDATE certificate SET draw = (SELECT max(draw) FROM candidate WHERE draw NOT IN "
                                     "(SELECT draw FROM certificate)) WHERE draw = (SELECT min(draw) FROM certificate)",
    "a yield of another draw": "UPDATE yield SET draw = 7 WHERE draw = (SELECT min(draw) FROM yield)",
    "an ascent of plain draws": "INSERT INTO ascent SELECT draw, 1, 2, 3, 4, 'most_steps', NULL FROM candidate LIMIT 1",
    "a level of plain draws": "INSERT INTO level VALUES (1, 1024, 1)",
    "a population of plain draws": "INSERT INTO population SELECT lo, 0, 1, 0, 0, 1, 0, 0, 0, 0 FROM unit LIMIT 1",
    "a sheet of plain draws": "INSERT INTO sheet SELECT draw, zeroblob(16) FROM candidate LIMIT 1",
    "a candidate of another draw": "UPDATE candidate SET draw = draw + 1 WHERE draw = (SELECT max(draw) FROM candidate)",
}
OF_SPLIT = {
    "hashes swapped": SWAP.format(table="sheet", column="hash"),
    "a sheet twice": "UPDATE sheet SET hash = (SELECT hash FROM sheet ORDER BY draw DESC)",
    "a population less": "DELETE FROM population WHERE unit = 0",
    "a level of a population less": "DELETE FROM population WHERE unit = 0 AND level = 1",
    "a level less": "DELETE FROM level WHERE number = 1",
    "survivors of a way that adds up": "UPDATE population SET met = met + 1 WHERE unit = 0 AND level = 1",
    "taken": "UPDATE population SET taken = taken - 1 WHERE unit = 0 AND level = 1",
    "a level's angle with its score": "UPDATE level SET score = score + 1024, deploys_from_deg = deploys_from_deg + 1 "
                                      "WHERE number = 1",
}
OF_BETTER = {
    "ends swapped": SWAP.format(table="ascent", column="end_value"),
    "starts swapped": SWAP.format(table="ascent", column="start_value"),
    "steps and sheets": "UPDATE ascent SET steps = steps + 1, sheets_folded = sheets_folded + 1 WHERE steps > 0",
    "an end of the other kind": "UPDATE ascent SET ended = 'most_steps', steps = 200, sheets_folded = 900 WHERE steps > 0",
    "kept as it is": "UPDATE ascent SET ended = 'breaks_a_limit', start_value = NULL, end_value = NULL, steps = 0, "
                     "sheets_folded = 0, limited_by = NULL WHERE draw = (SELECT min(draw) FROM ascent WHERE steps > 0)",
    "a limit's price": "UPDATE ascent SET limited_by = json_set(limited_by, '$.per_mm_of_amplitude', 1.0)",
    "a limit of no table": "UPDATE ascent SET limited_by = '{\"nonsense\": 1}' WHERE steps > 0",
    "the goal": key_of("campaign", "configuration", "$.search.maximise", "'energy_n_mm'"),
    "a limit of the campaign": key_of("campaign", "configuration", "$.search.subject_to", "json('[]')"),
    "steps at most": key_of("campaign", "configuration", "$.search.most_steps", 5),
    "an ascent less": "DELETE FROM ascent WHERE draw = (SELECT max(draw) FROM ascent)",
}
OF_PIECES = {
    "pieces swapped": "UPDATE piece SET result = (SELECT result FROM piece ORDER BY lo DESC LIMIT 1)",
    "a piece that overlaps": "UPDATE piece SET hi = hi + 5", "a piece less": "DELETE FROM piece WHERE lo = 0",
    "a piece of another level": "UPDATE OR IGNORE piece SET level = level + 1",
    "a piece of another population": "UPDATE OR IGNORE piece SET population = 0",
}
OWN = {  # kinds with a reason of their own
    "a rejected draw left undecided": "no verdict, as another build may have none; verify counts it: decided_now",
    "causes shared out otherwise": "by the build's tests; their sum is checked",
    "a stiffness": "what a sheet is used for, outside the identity", "wall time": "when a run ends, outside the identity",
}


def next_letter(text):
    """Another letter in the middle, or what stands there if no letter follows; a number's last digits are no lie."""
    middle = len(text) // 2
    after = re.search("[A-Za-z]", text[middle:])
    at = middle + after.start() if after else middle
    return text[:at] + chr(ord(text[at]) ^ 1) + text[at + 1:]


def bit_of(blob, at):
    return blob[:at] + bytes([blob[at] ^ 1]) + blob[at + 1:]


def opened(path):
    """A connection past keys and checks, with the functions of lies."""
    database = sqlite3.connect(path, isolation_level=None)
    for name, lie in (("next", lambda x: math.nextafter(x, math.inf)), ("letter", next_letter),
                      ("bit", lambda blob: bit_of(blob, len(blob) // 2)),
                      ("lastbit", lambda blob: bit_of(blob, len(blob) - 1))):
        database.create_function(name, 1, lambda value, lie=lie: lie(value) if value else None)
    database.executescript("PRAGMA foreign_keys = OFF; PRAGMA ignore_check_constraints = ON; PRAGMA writable_schema = ON")
    return database


def contents(path):
    database = opened(path)
    database.text_factory = bytes
    tables = [row[0].decode() for row in database.execute("SELECT name FROM sqlite_schema WHERE type = 'table'")]
    rows = {table: database.execute(f"SELECT * FROM {table}").fetchall() for table in tables}
    rows[""] = database.execute("SELECT name, sql FROM sqlite_schema ORDER BY name").fetchall()
    rows["pragmas"] = [database.execute(f"PRAGMA {name}").fetchone() for name in ("user_version", "application_id")]
    database.close()
    return rows


def columns_of(path):
    """Table, column, its type, whether it is never null and the first of that type, of tables with rows."""
    database, columns, types = opened(path), [], set()
    for [table] in database.execute("SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY rowid").fetchall():
        if not database.execute(f"SELECT count(*) FROM {table}").fetchone()[0]:
            continue
        for _, column, kind, is_filled, _, _ in database.execute(f"PRAGMA table_info({table})"):
            columns.append((table, column, kind, is_filled, (table, kind) not in types))
            types.add((table, kind))
    database.close()
    return columns


def falsify(path, sql, table):
    """False if there is nothing to change; of a cell's table types, and what guards the ledger, are off meanwhile."""
    before, database = contents(path), opened(path)
    [guard] = database.execute("SELECT sql FROM sqlite_schema WHERE name = 'unit_moves'").fetchone()
    if table:
        keys = ", ".join(quoted(row[1]) for row in database.execute(f"PRAGMA table_info({table})") if row[5])
        sql += f" WHERE ({keys}) = (SELECT {keys} FROM {table} ORDER BY {keys} LIMIT 1 OFFSET (SELECT count(*) / 2 FROM {table}))"
        [typed] = database.execute("SELECT sql FROM sqlite_schema WHERE name = ?", (table,)).fetchone()
        typeless = typed.replace(" STRICT, ", " ").replace(" STRICT", "").replace(" NOT NULL", "")
        database.execute("UPDATE sqlite_schema SET sql = ? WHERE name = ?", (typeless, table))
        database.close()
        database = opened(path)
    try:
        database.executescript(f"DROP TRIGGER unit_moves; {sql}; {guard}")
    except sqlite3.IntegrityError:  # a key that is none, or another row's
        database.close()
        return False
    if table:
        database.execute("UPDATE sqlite_schema SET sql = ? WHERE name = ?", (typed, table))
    database.close()
    return contents(path) != before


class Subjects:
    """The honest catalogues, their other halves, and what is answered about them."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        for name, (campaign, counted, count, more, options) in CATALOGUES.items():
            (folder / f"{name}.json").write_text(f'{{"name": "{name}", {campaign}}}')
            stop = ["--max-time", "1"] if name == "pieces" else []
            self.must("search", f"{name}.json", "--catalogue", f"{name}.db", f"--{counted}", str(count), *options, *stop)
            half = f"{count}:{count + max(more, 1)}"
            self.must("search", f"{name}.json", "--catalogue", f"{name}-other.db", "--range", half, *options)
        self.must("certify", "plain.db", "--best", "5")
        self.must("tolerance", "plain.db", "--best", "5", "--amplitude", "0.1", "--trials", "20")
        self.honest = {}
        for name in CATALOGUES:
            answers, calls = self.asked(name, folder / f"{name}.db")
            wrong = [f"{verb} ends with {call.returncode}: {call.stderr}" for verb, call in calls if call.returncode]
            if wrong:
                sys.exit(f"the honest catalogue {name}: {wrong}")
            self.honest[name] = answers

    def must(self, verb, *words):
        subprocess.run([self.program, verb, *words], cwd=self.folder, check=True, capture_output=True, timeout=SECONDS)

    def asked(self, name, path):
        """What is answered about that catalogue, and (verb, how it ended) of each call."""
        _, counted, count, more, options = CATALOGUES[name]
        answers, calls = {}, []
        with tempfile.TemporaryDirectory() as place:
            def call(verb, *words):
                try:
                    done = subprocess.run([self.program, verb, *words], cwd=place, capture_output=True, timeout=SECONDS)
                except subprocess.TimeoutExpired:
                    done = subprocess.CompletedProcess(words, None, b"", b"")
                calls.append((verb, done))
                return done

            def copy():
                shutil.copy(path, Path(place) / "some.db")

            copy()
            verified = call("verify", "some.db", "--all", "--units", "1000", "--seed", "1", "--json")
            answers["status"] = call("status", "some.db", "--json").stdout
            for query in QUERIES if verified.returncode == 0 else QUERIES[:1]:
                answers[query] = call("query", "some.db", query, "--json").stdout
            merged = call("merge", "all.db", "some.db", str(self.folder / f"{name}-other.db"))
            answers["digest of merge"] = merged.returncode == 0 and digest(call("status", "all.db", "--json"))
            copy()
            went_on = call("search", str(self.folder / f"{name}.json"), "--catalogue", "some.db", f"--{counted}",
                           str(count + more), "--progress", "none", *options)
            answers["digest of search"] = went_on.returncode == 0 and digest(went_on)
        return answers, calls


def digest(said):
    found = re.search(rb'digest\W+(\w+)', said.stdout)
    return found and found.group(1)


def fault_of(verb, done):
    said = done.stderr.decode("utf-8", "replace")
    if done.returncode is None:
        return f"{verb} hangs"
    if done.returncode < 0 or "terminate called" in said or "Sanitizer" in said:
        return f"{verb} crashed ({done.returncode})"
    if done.returncode not in CODES:
        return f"{verb} ends with {done.returncode}"
    if CONTROL.search(said):
        return f"{verb}: control characters on standard error"
    if any(word in said for word in ("std::", "basic_string", "json.exception", "what()")):
        return f"{verb}: an inner word is shown"
    return None


def judged(subjects, catalogue, name, path):
    """One word for what became of a lie, and more about it."""
    answers, calls = subjects.asked(catalogue, path)
    ends = {}
    for verb, done in calls:
        ends.setdefault(verb, done.returncode)
    codes = " ".join(f"{verb} {code}" for verb, code in ends.items())
    faults = [fault for fault in (fault_of(verb, done) for verb, done in calls) if fault]
    if faults:
        return "FAULT", f"{codes}: {'; '.join(faults)}"
    if ends["verify"] in (3, 5):
        return "refused", codes
    if ends["verify"] == 6:
        return "found", codes
    if ends["verify"] != 0:
        return "FAULT", f"{codes}: verify ends with {ends['verify']}"
    honest = subjects.honest[catalogue]
    others = [asked for asked in answers if answers[asked] not in (honest[asked], False)]
    if not others:
        return "no answer differs", codes
    cell, _, lie = name.partition(": ")
    reason = OWN.get(name) or (ROUNDING if lie == "a bit more" else ADVICE.get(cell))
    return ("advice", f"{codes} ({reason})") if reason else ("TAKEN", f"{codes}: another {', '.join(others)}")


def kinds_of(folder):
    """Catalogue, name, SQL and, of a cell, its table."""
    special = {"plain": EVERY | OF_PLAIN, "split": EVERY | OF_SPLIT, "better": OF_BETTER, "pieces": OF_PIECES}
    seen, kinds = set(), []
    for catalogue in CATALOGUES:
        for table, *column in columns_of(folder / f"{catalogue}.db"):
            if (table, column[0]) not in seen:
                seen.add((table, column[0]))
                lies = lies_about(table, *column)
                kinds += [(catalogue, name, sql, table) for name, sql in lies.items()]
        kinds += [(catalogue, name, sql, None) for name, sql in special[catalogue].items()]
    return kinds


def main():
    program, words = str(Path(sys.argv[1]).resolve()), sys.argv[2:]
    os.environ |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    with tempfile.TemporaryDirectory() as place, ThreadPoolExecutor(WORKERS) as workers:
        folder = Path(place)
        subjects = Subjects(program, folder)

        def tried(number, kind):
            catalogue, name, sql, table = kind
            path = folder / f"false-{number}.db"
            shutil.copy(folder / f"{catalogue}.db", path)
            told = falsify(path, sql, table)
            verdict = judged(subjects, catalogue, name, path) if told else ("not to be written", "")
            path.unlink()
            print(f"{catalogue}: {name}: {verdict[0]}; {verdict[1]}", flush=True)
            return verdict[0]

        kinds = [kind for kind in kinds_of(folder) if not words or any(word in kind[1] for word in words)]
        verdicts = Counter(workers.map(tried, range(len(kinds)), kinds))
    print(f"{sum(verdicts.values()) - verdicts['not to be written']} kinds: "
          + ", ".join(f"{count} {verdict}" for verdict, count in sorted(verdicts.items())))
    return verdicts["FAULT"] + verdicts["TAKEN"] > 0


if __name__ == "__main__":
    sys.exit(main())
