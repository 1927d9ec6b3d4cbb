#!/usr/bin/env python3
"""Counts words that readers stumble over, by layer: words.py. What stands where: words.py --list KIND [FOLDER].
words.py --check fails where a page is misspelled, a subject is long or reference/words.md is not the glossary; the counts
may only fall (scripts/house.json). words.py --write makes reference/words.md of scripts/words/glossary.json."""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LAYERS = ("solver", "schema", "search", "manual")
OPENINGS = set("what which where when how who whose why whether that as of for in on at by from to with without within "
               "between behind beside before after until over under above below through along among against off "
               "into so than".split())
PRONOUNS = re.compile(r"\b(own|one|here|by|of|said|worth|found_)\b(?! *[(\"])")
MOST_WORDS, MOST_OF_SUBJECT, SUBJECTS = 30, 72, 50
COMMENT = re.compile(r"(?://[/!]?<?|/\*\*|\* )(.*)")
LITERAL = re.compile(r'"((?:\\.|[^"\\\n])*)"')
LABEL_END = re.compile(r"\b(?:of|with|at|from|by|to|as|than|for|in|on|up to):?$")
WORDS_PAGE = ROOT / "search/manual/reference/words.md"
SPELLING = ROOT / "scripts/words/spelling.txt"


def glossary():
    return json.loads((ROOT / "scripts/words/glossary.json").read_text())


def replaced():
    """One pattern of all that the terms replace."""
    patterns = [pattern for terms in glossary().values() for _, _, old in terms for pattern in old]
    return re.compile("|".join(patterns))


def tracked(*patterns):
    names = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", *patterns], cwd=ROOT,
                           check=True, capture_output=True, text=True).stdout.splitlines()
    return sorted({name for name in names if (ROOT / name).is_file()})


def layer_of(name):
    return "manual" if name.endswith(".md") else name.split("/")[0]


def cpp():
    return tracked("solver/*.[ch]pp", "schema/*.[ch]pp", "search/*.[ch]pp")


def pages():
    return tracked("*.md", ":!results", ":!tests/golden", ":!CHANGELOG.md")


def prose(text):
    """A page without code, tables, links and headings; its paragraphs apart."""
    text = re.sub(r"```.*?```", "\n\n", text, flags=re.S)
    text = re.sub(r"^(?:\|.*|    .*|#.*)$", "\n", text, flags=re.M)
    text = re.sub(r"\$\$.*?\$\$", "", text, flags=re.S)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]*`", "code", text)
    text = re.sub(r'<img [^>]*alt="([^"]*)"[^>]*>|</?[a-z][^<>]*>', r"\1", text)
    return re.split(r"\n\s*\n|^\s*(?:[-*]|\d+\.) ", text, flags=re.M)


def readable(name):
    """The prose of a page, or of a module's docstrings without their examples."""
    text = (ROOT / name).read_text()
    if name.endswith(".py"):
        docstrings = re.findall(r'"""(.*?)"""', text, re.S)
        text = "\n\n".join(re.sub(r"^ *(?:>>>|\.\.\. ).*\n(?: *\S.*\n)?", "", each, flags=re.M) for each in docstrings)
        text = re.sub(r"^ +", "", text, flags=re.M)
    return re.sub(r"'s\b", "", "\n\n".join(prose(text)))


def openings_of(names):
    for name in names:
        inside = False
        for number, line in enumerate((ROOT / name).read_text().splitlines(), 1):
            comment = COMMENT.match(line.lstrip()) or re.search(r"///<(.*)", line)
            first = re.match(r" *[`(]?([A-Za-z']+)", comment[1]) if comment else None
            if first and not inside and first[1].lower() in OPENINGS:
                yield name, number, line.strip()
            inside = bool(comment and comment[1].strip()) and line.lstrip().startswith(("//", "*"))


def openings():
    """Comments that open with a question word or a preposition."""
    return openings_of([*cpp(), *tracked("schema/report/*.js", "tests/report/*.mjs")])


def openings_of_tests():
    """Comments of tests that open with a question word or a preposition."""
    return openings_of(tracked("tests/*.[ch]pp"))


def replaced_terms():
    """What a term of the glossary replaces, in pages, comments and texts."""
    pattern = replaced()
    for name in pages() + cpp() + tracked("schema/*.json", "schema/*.js", "search/python/*.py"):
        if name.startswith("scripts/") or name == "CONTRIBUTING.md":
            continue
        for number, line in enumerate((ROOT / name).read_text().splitlines(), 1):
            if name.endswith("pp"):
                line = " ".join([*COMMENT.findall(line), *LITERAL.findall(line)])
            if pattern.search(line):
                yield name, number, line.strip()


def pronouns():
    """Identifiers that are pronouns or prepositions."""
    for name in cpp():
        for number, line in enumerate((ROOT / name).read_text().splitlines(), 1):
            if line.startswith("#"):
                continue
            code = COMMENT.sub("", LITERAL.sub('""', line))
            for _ in PRONOUNS.findall(code):
                yield name, number, line.strip()


def labels():
    """Labels that are no noun phrases: they end in a preposition."""
    for name in tracked("search/sheets/*.cpp", "search/terminal/*.cpp", "schema/kit/*.cpp", "schema/exchange/*.cpp",
                        "schema/catalogue/*_table.cpp", "schema/report/*.js"):
        for number, line in enumerate((ROOT / name).read_text().splitlines(), 1):
            for text in LITERAL.findall(line):
                if text.count(" ") >= 2 and LABEL_END.search(text):
                    yield name, number, text


def long_sentences():
    """Sentences of more than thirty words."""
    for name in pages():
        for paragraph in prose((ROOT / name).read_text()):
            for sentence in re.split(r"(?<=[.:;!?])\s+", " ".join(paragraph.split())):
                if len(sentence.split()) > MOST_WORDS:
                    yield name, 0, sentence


def subjects():
    """Subjects of the last commits over 72 characters."""
    log = subprocess.run(["git", "log", f"-{SUBJECTS}", "--no-merges", "--format=%s"], cwd=ROOT, capture_output=True, text=True)
    for subject in log.stdout.splitlines():
        if len(subject) > MOST_OF_SUBJECT:
            yield "git", 0, subject


KINDS = {"openings": openings, "openings-of-tests": openings_of_tests, "replaced": replaced_terms, "pronouns": pronouns, "labels": labels,
         "sentences": long_sentences, "subjects": subjects}


def held():
    """The counts that scripts/house.json holds; that of subjects must be none."""
    for kind in list(KINDS.values())[:-1]:
        yield kind.__doc__.rstrip(".")[0].lower() + kind.__doc__.rstrip(".")[1:], sum(1 for _ in kind())


def words_page():
    lines = ["# Words", "", "*Reference.* What words mean in the program, its files and this manual.", ""]
    for field, terms in glossary().items():
        lines += [f"## {field.capitalize()}", "", "| term | meaning |", "|---|---|"]
        lines += [f"| {term} | {meaning} |" for term, meaning, _ in sorted(terms, key=lambda row: row[0].lower())] + [""]
    return "\n".join(lines)


def misspelled():
    """Words of pages that are in no dictionary and not among the field's."""
    known = set(SPELLING.read_text().lower().split())
    for name in tracked("*.md", "search/python/*.py", ":!tests/golden"):
        words = subprocess.run(["hunspell", "-l", "-i", "utf-8", "-d", "en_GB"], check=True,
                               input=readable(name), capture_output=True, text=True)
        for word in sorted(set(words.stdout.split())):
            if word.lower() not in known and re.fullmatch(r"[A-Za-zé]{3,}", word):  # no formulas, units and hashes
                yield f"{name}: {word} is in no dictionary; mend it, or add it to scripts/words/spelling.txt"


def table():
    rows = [[name.removesuffix(".")] + [0] * len(LAYERS) + [0] for name in (kind.__doc__ for kind in KINDS.values())]
    for row, kind in zip(rows, KINDS.values()):
        for name, _, _ in kind():
            if layer_of(name) in LAYERS:
                row[1 + LAYERS.index(layer_of(name))] += 1
            row[-1] += 1
    print("| |", " | ".join((*LAYERS, "all")), "|\n|" + "---|" * (len(LAYERS) + 2))
    for row in rows:
        print("|", " | ".join(map(str, row)), "|")


def main(arguments):
    if arguments[:1] == ["--list"]:
        for name, number, text in KINDS[arguments[1]]():
            if name.startswith(tuple(arguments[2:]) or ("",)):
                print(f"{name}:{number}: {text}")
        return 0
    if arguments == ["--write"]:
        WORDS_PAGE.write_text(words_page())
        return 0
    if arguments == ["--check"]:
        faults = [*misspelled(), *(f"{text}: a subject of over {MOST_OF_SUBJECT} characters" for _, _, text in subjects())]
        if WORDS_PAGE.read_text() != words_page():
            faults.append("reference/words.md is not what scripts/words.py --write makes")
        print(*faults, sep="\n", end="\n" if faults else "", file=sys.stderr)
        return bool(faults)
    table()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
