#!/usr/bin/env python3
"""reference.py PROGRAM: compares the reference pages that are kept in the repository with what the program says.
With --write: writes them.

Reference pages are never typed: verbs and keys are what the program prints, faults, metrics and studies the words that its
report carries, tables and views what schema/catalogue.sql makes, exit codes those of the manual pages.
"""

import html
import inspect
import json
import pathlib
import re
import sqlite3
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
MANUAL = ROOT / "search/manual"


def said(program, *words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def verbs_of(program):
    """Each verb with its sentence, as `misalign help` lists them."""
    listed = re.search(r"^Verbs:\n(.*?)\n\n", said(program, "help"), re.M | re.S)[1]
    entries = re.findall(r"^  (\w+) +(\S.*(?:\n {4,}\S.*)*)", listed, re.M)
    return {name: re.sub(r"\s+", " ", words) for name, words in entries}


def words_of(program):
    """Faults, metrics and studies, as the report of a pattern carries them."""
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.html"
        said(program, "report", ROOT / "search/patterns/table1.json", "--output", page)
        found = re.search(r'id="report-words">(.*?)</script>', page.read_text(encoding="utf-8"), re.S)
    return json.loads(html.unescape(found[1]))


def table(heads, rows):
    def line(cells):
        return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |\n"

    return line(heads) + line(["---"] * len(heads)).replace(" ", "") + "".join(map(line, rows))


def page(title, sentence, *parts):
    return f"# {title}\n\n*Reference.* {sentence}\n\n" + "\n".join(parts)


def verbs_page(verbs, linked):
    """`linked`: on the site, which has a page for each."""
    return page("Verbs", "What `misalign` can be told to do; `misalign help VERB` says how, with examples.",
                table(["verb", "does"], ([f"[`{name}`](misalign-{name}.md)" if linked else f"`{name}`", words]
                                         for name, words in verbs.items())))


def verb_page(program, name):
    return page(f"misalign {name}", f"What `misalign help {name}` prints.",
                f"```text\n{said(program, 'help', name).rstrip()}\n```\n")


def faults_page(words):
    return page("Faults", "The first of these ends the range of angles from which a sheet deploys; "
                "[more about verdicts](../explanation/verdicts.md).",
                table(["fault", "in words", "meaning"],
                      ([f"`{each['name']}`", each["label"], each["meaning"]] for each in words["faults"])))


def columns_page(words):
    def entries(of):
        return table(["column", "unit", "meaning"], ([f"`{each['name']}`", each["unit"], each["meaning"]] for each in of))

    database = sqlite3.connect(":memory:")
    source = (ROOT / "schema/catalogue.sql").read_text(encoding="utf-8")
    database.executescript(source)
    views, tables = [], []
    for name, kind in database.execute("SELECT name, type FROM sqlite_schema WHERE type IN ('table', 'view') "
                                       "AND name NOT LIKE 'sqlite_%' ORDER BY rowid"):
        columns = [row[1] for row in database.execute(f'PRAGMA table_xinfo("{name}")')]
        head = re.search(rf"((?:^--.*\n)*)^CREATE {kind.upper()} {name}\b.*\n((?:.*\n)*?)(?=\n|\Z)", source, re.M)
        about = " ".join(line.removeprefix("--").strip() for line in head[1].splitlines())
        remarks = dict(re.findall(r'^ {2}"?(\w+)"? .*?-- (.*)$', head[2], re.M)) if kind == "table" else {}
        entry = f"### {name}\n\n{about}\n\n".replace("\n\n\n\n", "\n\n") + \
            ", ".join(f"`{each}`" + (f" ({remarks[each]})" if each in remarks else "") for each in columns) + "\n"
        (views if kind == "view" else tables).append(entry)
    return page("Columns", "What can be asked of a catalogue, by `misalign query`, `--where` and `--by`.",
                "## Metrics of candidates\n\nColumns of the view `candidates` and of the report's table.\n", entries(words["metrics"]),
                "## Functions of a draw\n\nWhat a study says, with the design of the campaign, for `query`, every `--where` and `--by`, `report --column` "
                "and Python: `NAME(draw)`, `NAME(draw, from_deg)` from another angle of use, or `NAME` alone. `D` is "
                "`deploys_from_deg`. Numbers are remembered in `CATALOGUE.studies`, by function, its version, the campaign with its "
                "design, angle, draw and shifts: `verify` computes a sample again, and the file may be deleted at any time.\n",
                entries(words["columns_of_studies"]),
                "## Views\n", *views, "## Tables\n", "The views are made of these.\n", *tables)


def exit_codes_page():
    source = (ROOT / "search/man/common.h2m").read_text(encoding="utf-8")
    section = source.partition("[EXIT STATUS]")[2].partition("\n[")[0]
    rows = [each.strip().partition("\n") for each in section.split(".TP\n")[1:]]
    return page("Exit codes", "What `misalign` ends with.",
                table(["exit code", "meaning"],
                      ([code, re.sub(r"\\-", "-", words).replace("\n", " ")] for code, _, words in rows)))


def studies_page(words):
    return page("Studies", "What can be asked of one sheet that was found; each is a verb.",
                table(["study", "says"], ([f"`misalign {name}`", words] for name, words in words.items())))


def keys_page(program):
    return page("Keys of campaigns and patterns", "What `misalign config --keys` prints.",
                said(program, "config", "--keys"))


def materials_page(program):
    materials, hinges = said(program, "config", "--materials").split("\n\n")
    return page("Materials and hinges", "Names for a [design](../how-to/design.md) and for options: what `misalign config --materials` "
                "prints, as JSON with `--json`.",
                "## Materials\n\n`\"material\": \"birch plywood\"` in a design, `{ \"like\": \"birch plywood\", \"e_gpa\": 9.5 }` "
                "for one that differs, or `--material \"birch plywood\"`.\n", materials + "\n",
                "The sustained stress is what panels may bear as long as springs load a stored sheet; a [card](../how-to/card.md) judges "
                "it. It is the short-term strength times a factor, because most of these materials creep:\n\n"
                "- metals: 2/3 of the yield strength (ASME BPVC, Section II, Part D)\n"
                "- wood: the characteristic bending strength times k_mod of permanent loads in dry rooms, 0.6 for plywood and 0.2 for MDF "
                "(EN 1995-1-1, table 3.1), without partial factors\n"
                "- acrylic: 1500 psi for continuous loads, above which it crazes\n"
                "- polypropylene: 10 MPa, its strength over 50 years at 20 °C (ISO 15494), divided by 1.6 (ISO 12162)\n"
                "- PLA and PETG: 0.15 of the tensile strength. No standard has a value; acrylic has the share 0.14, polypropylene 0.17\n"
                "- carbon laminate: the stress at which the first ply cracks, times 0.55 (creep rupture, ACI 440.2R)\n\n"
                "Plates are isotropic. Plywood, board and laminates are not: their moduli are means over directions. Numbers vary among "
                "makers: measure a strip of yours before you rely on a margin.\n",
                "## Hinges\n\n`\"hinges\": { \"like\": \"polyester film 0.1 mm\" }` in a design, or `--hinge`; "
                "[how to choose](../how-to/hinges.md). Of ranges, friction is the upper end and play the middle.\n", hinges)


def queries_page():
    files = sorted((ROOT / "schema/queries").glob("*.sql"))
    return page("Named queries", "`misalign query FILE.db NAME` runs one of these; "
                "[ten questions more](../../../schema/queries/README.md).",
                *(f"## {file.stem}\n\n```sql\n{file.read_text(encoding='utf-8').rstrip()}\n```\n" for file in files))


def documented(thing):
    try:
        signature = f"{thing.__name__}{inspect.signature(thing)}\n\n" if callable(thing) else ""
    except ValueError:
        signature = ""
    return f"```text\n{signature}{inspect.getdoc(thing)}\n```\n"


def python_page():
    """Words of the package, which has to be on PYTHONPATH for it."""
    import misalign

    parts = [f"```text\n{inspect.getdoc(misalign)}\n```\n"]
    for name in misalign.__all__:
        thing = getattr(misalign, name)
        if callable(thing):
            parts.append(f"## {name}\n\n{documented(thing)}")
        if inspect.isclass(thing):
            parts += [f"### {name}.{each}\n\n{documented(method)}" for each, method in vars(thing).items()
                      if not each.startswith("_") and inspect.getdoc(method)]
    return page("Python", "The package `misalign`, as `help(misalign)` shows it.", *parts)


def kept_pages(program):
    """Those in the repository, for readers on the web: name below search/manual/, and text."""
    words = words_of(program)
    return {"reference/verbs.md": verbs_page(verbs_of(program), False), "reference/faults.md": faults_page(words),
            "reference/columns.md": columns_page(words), "reference/exit-codes.md": exit_codes_page(),
            "reference/materials.md": materials_page(program)}


def pages(program):
    """All of them."""
    verbs = verbs_of(program)
    studies = {name: words for name, words in verbs.items()
               if list(ROOT.glob(f"solver/*/{name}.hpp")) or name in ("tolerance", "stress", "certify")}
    return {**kept_pages(program), "reference/verbs.md": verbs_page(verbs, True), "reference/studies.md": studies_page(studies), "reference/keys.md": keys_page(program),
            "reference/queries.md": queries_page(), "reference/python.md": python_page(),
            **{f"reference/misalign-{name}.md": verb_page(program, name) for name in verbs}}


def main():
    program = sys.argv[1]
    for name, text in kept_pages(program).items():
        file = MANUAL / name
        if "--write" in sys.argv:
            file.write_text(text, encoding="utf-8")
        elif not file.exists() or file.read_text(encoding="utf-8") != text:
            sys.exit(f"search/manual/{name} is not what the program says; scripts/site/reference.py PROGRAM --write")


if __name__ == "__main__":
    main()
