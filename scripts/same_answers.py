#!/usr/bin/env python3
"""Says whether two builds of the program give the same answers, which moving code about must not change.
same_answers.py record PROGRAM DIR writes the answers of a program into a new directory: digests and candidates of
campaigns, every verb's JSON on fixed inputs, exports, certificates, the page's data.
same_answers.py compare DIR_A DIR_B prints where they differ: exit code 1 where a number does, 0 where only words do."""

import argparse
import concurrent.futures
import hashlib
import itertools
import json
import os
import re
import shlex
import shutil
import sqlite3
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
PROCESSES = 2
MILLION = 1_000_000
# Keys that say which build, which machine, when and how fast.
STRIPPED = {"version", "commit", "written_at", "seconds", "worker_seconds", "cpu_s", "core_s", "memory_mb", "draws_per_s"}
# Campaigns that ask for what no shipped one does, as changes to miura-4x4.
OTHERS = {
    "parallel": {"misalignment": {"kind": "parallel", "levels": "uniform", "vertices": "all"}, "path": {"end_deg": 179}},
    "uniform": {"misalignment": {"levels": "uniform"}},
    "cubic": {"accept": {"between_samples": True}},
    "exact": {"accept": {"between_samples": "exact"}},
    "stop": {"accept": {"stops_at_deg": 60, "stop_stiffness_mm2_per_rad2": 1}},
}
ASCENTS = {  # the same of optimising ones
    "friction": {"from_deg": 36, "subject_to": ["stroke_max <= 0.06", "miscut_margin_mm >= 0.005"]},
    "margin": {"maximise": "miscut_margin_mm", "shifts": "ternary"},
    "energy": {"maximise": "energy_n_mm", "from_deg": 36, "grid_mm": 0.05},
}
SMALL = {"particles": 40, "sweeps": 3, "first_draws": 4000}  # of a population that takes seconds
# Verbs without a case, and why.
NO_ANSWER = {"search": "campaigns/", "export": "exports/", "completion": "words", "help": "words",
             "watch": "the data of report's page"}
NO_JSON = {"merge", "config"}
# A line for each case: its name, then the arguments. {draw} is a candidate of small.db (4 x 4), {six} one of six.db.
CASES = """
status               status small.db --at 170
status-splitting     status rare.db
status-optimising    status better.db
fold                 fold patterns/table1.json
fold-half-degrees    fold patterns/table1.json --to 90 --step 0.5
fold-constructed     fold made.json --to 179
fold-graded          fold patterns/miura-graded-6x6.json
fold-wide            fold patterns/miura-wide-6x6.json
fold-narrow          fold patterns/miura-narrow-6x6.json
fold-corrugation     fold patterns/double-corrugation-6x6.json
fold-angle-array     fold patterns/angle-array-6x6.json
fold-turned-quads    fold patterns/turned-quads-6x6.fold
perforations         perforations patterns/turned-quads-6x6.json
perforations-two     perforations patterns/table1.json --holes 2
construct            construct patterns/table1.json --amplitude 4
construct-rim        construct patterns/miura-graded-6x6.json --rim --stroke 0.01 --amplitude 2
shape                shape patterns/dome-6x6.json
shape-bistable       shape patterns/dome-6x6.json --kind bistable --from 99 --barrier 2
optimise-friction    optimise small.db {draw}
optimise-bent        optimise patterns/table1.json --deploys-from 150 --goal bent_critical_friction_n_mm_per_mm --steps 2
optimise-static      optimise patterns/table1.json --deploys-from 150 --goal static_friction_n_mm_per_mm --thickness 2 --preload 0.1 --steps 3
optimise-miscuts     optimise patterns/table1.json --deploys-from 150 --goal miscut_margin_mm --steps 4
optimise-energy      optimise patterns/table1.json --deploys-from 150 --goal energy_n_mm --steps 4
optimise-angle       optimise patterns/table1.json --goal deploys_from_deg --steps 4
optimise-stiffness   optimise patterns/table1.json --deploys-from 150 --goal rest_stiffness_n_mm_per_rad --preload 0.05 --preload-within 0,0.2 --steps 3
optimise-thickness   optimise patterns/table1.json --deploys-from 150 --goal thickness_mm --from 36 --steps 1
optimise-yield       optimise patterns/table1.json --deploys-from 150 --goal yield --miscut 0.05 --trials 100 --steps 1
optimise-spare       optimise patterns/table1.json --deploys-from 150 --goal spare_diagonals --from 36 --steps 2
optimise-grid        optimise patterns/table1.json --deploys-from 150 --grid 0.05 --steps 3
optimise-limits      optimise patterns/table1.json --deploys-from 150 --subject-to "stroke_max <= 0.1" --subject-to "largest_force_n <= 200" --stiffness-within 10,200 --steps 3
optimise-family      optimise made.json --within-family --deploys-from 179 --from 36 --steps 3
optimise-card        optimise patterns/table1.json --deploys-from 150 --ternary --thickness 1 --card --steps 2
replay               replay small.db {draw}
replay-rejected      replay small.db 0
replay-again         replay better.db {better} --again
query-acceptance     query small.db acceptance
query-best           query small.db best
query-ends           query better.db ends
query-rejections     query small.db rejections
query-simplest       query small.db simplest
query-smooth         query small.db smooth
query-stroke         query small.db stroke
query-strongest      query small.db strongest
query-tolerant       query small.db tolerant
query-yields         query small.db yields
query-front          query small.db --front miscut_margin_mm,stroke_max
query-functions      query six.db "SELECT draw, deploy_time_s(draw), critical_friction_n_mm_per_mm(draw), stall_deg(draw), landing_rate_deg_per_s(draw), bent_energy_n_mm(draw), bent_critical_friction_n_mm_per_mm(draw), static_friction_n_mm_per_mm(draw), static_margin(draw), first_contact_deg(draw), thickness_mm(draw), energy_n_mm(draw) FROM candidate ORDER BY draw LIMIT 10"
verify               verify small.db --sample 20 --units 1 --seed 1
verify-splitting     verify rare.db --sample 10
verify-pattern       verify patterns/table1.json
certify-pattern      certify patterns/table1.json --to 150 --contact
certify-closed-form  certify made.json --closed-form --to 180
tolerance            tolerance small.db {draw} --amplitude 0.05 --trials 200 --vertices --jobs 1 --no-keep
tolerance-best       tolerance six.db --best 5 --amplitude 0.02 --trials 100 --jobs 1 --no-keep
backlash             tolerance patterns/table1.json --backlash 0.01 --backlash-from 30 --trials 50 --jobs 1
actuators            actuators small.db {draw}
actuators-buy        actuators patterns/table1.json --buy --from 120 --friction 0.000002
actuators-limited    actuators patterns/table1.json --from 140 --stroke-limit 0.08 --preload 1
contact              contact small.db {draw}
contact-trimmed      contact patterns/table1.json --from 90 --trim 8
deploy               deploy six.db {six}
deploy-friction      deploy patterns/table1.json --friction 0.001 --damping 0.02 --least-damping
deploy-latch         deploy patterns/table1.json --latch --forces motion
deploy-swings        deploy patterns/table1.json --stop 0.3 --swings 2
deploy-held          deploy patterns/table1.json --forces held --pin-friction 0.1
deploy-gravity       deploy patterns/table1.json --hold 0,0 --gravity 0,0,-1
deploy-relaxed       deploy patterns/table1.json --rest-deg 60 --from 120 --damping 0.05
deploy-elastic       deploy patterns/table1.json --pull-only --hinge-stiffness 0.1 --ball-friction 1 --density 7.8
deploy-bent          deploy patterns/table1.json --panels bend --thickness 4 --preload 3 --margin-to 2
deploy-bent-pins     deploy six.db {six} --panels bend --thickness 2 --friction 0.001 --pin-friction 0.1 --preload 1
card                 card six.db {six} --thickness 1 --miscut 0.05 --friction 0.0001 --trials 200 --jobs 1
card-loose           card patterns/table1.json --from 90 --thickness 1 --play 0.01 --pin-friction 0.1 --preload 1 --trials 50 --jobs 1
report               report six.db --deploy --contact --column static_margin --column thickness_mm --details 12
report-splitting     report rare.db --details 6
report-optimising    report better.db --details 6
report-pattern       report patterns/table1.json --contact
bench                bench --agree 20
bench-rejections     bench campaigns/miura-4x4.json --rejections 100
doctor               doctor
merge                merge joined.db part-1.db part-2.db
config               config --default
config-keys          config --keys
config-materials     config --materials
config-wrong         config --check wrong.json
stress               stress patterns/table1.json --time-limit 0.002 --output stress
"""
EXPORTS = """
stl          --format stl --from 90 --thickness 1
csv          --format csv --creases --every 5
fold-joined  --format fold --joined --step 30
svg-cut      --format svg --only-cut
svg-kit      --format svg --kit --guide --test-piece --kerf 0.15 --joint-bore 1.2 --spring-bore 1.5
dxf-kit      --format dxf --kit --crease cut --bed 600x400
dxf-plates   --format dxf --kit --crease bevel --thickness 3 --from 90 --joint-bore 1.2 --spring-bore 1.5
3mf-plates   --format 3mf --kit --crease pin --thickness 4 --from 90
"""
CERTIFIED = {"small.db": 260, "six.db": 40}  # how many candidates of each catalogue


class Recorder:
    """Runs the program in a folder with the inputs, and writes what it answers."""

    def __init__(self, program, target, work):
        self.program, self.target, self.work = program, target, work
        self.environment = {**os.environ, "LC_ALL": "C", "OMP_NUM_THREADS": "1", "NO_COLOR": "1"}

    def run(self, *arguments):
        return subprocess.run([self.program, *arguments], cwd=self.work, env=self.environment,
                              capture_output=True, text=True, errors="replace", check=False)

    def write(self, place, text):
        path = self.target / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        print(place, flush=True)

    def write_json(self, place, answer):
        self.write(place + ".json", json.dumps(stripped(answer), indent=1, sort_keys=True) + "\n")

    def search(self, campaign, catalogue, *options):
        return self.run("search", campaign, "--catalogue", catalogue, "--progress", "none", *options)

    def rows(self, catalogue, sql):
        return json.loads(self.run("query", catalogue, sql, "--json").stdout or "null")

    def status(self, catalogue):
        return json.loads(self.run("status", catalogue, "--json").stdout or "null")

    def first_candidate(self, catalogue):
        with sqlite3.connect(f"file:{self.work / catalogue}?mode=ro", uri=True) as database:
            return database.execute("SELECT draw FROM candidate ORDER BY deploys_from_deg DESC, draw").fetchone()[0]

    def campaign(self, name, campaign, *options):
        """What a search finds: identity, counts, digest; levels, populations and ascents; the first candidates."""
        catalogue = f"campaign-{name}.db"
        (self.work / f"searched/{name}.json").write_text(json.dumps(campaign))
        searched = self.search(f"searched/{name}.json", catalogue, *options)
        answer = {"options": options, **outcome(searched), "status": self.status(catalogue),
                  "candidates": self.rows(catalogue, "SELECT * FROM candidates ORDER BY draw LIMIT 100")}
        method = campaign.get("search", {}).get("method", "plain")
        if method == "splitting":
            answer["levels"] = self.rows(catalogue, "SELECT * FROM level")
            answer["populations"] = self.rows(catalogue, "SELECT * FROM population ORDER BY unit, level")
        if method == "optimise":
            answer["ascents"] = self.rows(catalogue, "SELECT * FROM ascent ORDER BY draw")
        self.write_json(f"campaigns/{name}", answer)

    def case(self, name, arguments):
        verb = arguments[0]
        done = self.run(*arguments, *([] if verb in NO_JSON else ["--json"]))
        answer = {"arguments": arguments, **outcome(done)}
        try:
            answer["answer"] = json.loads(done.stdout)
        except ValueError:
            answer["answer"] = done.stdout.splitlines()
        if verb == "doctor":  # the rest is the machine's
            answer = [check for check in answer["answer"]["checks"] if check["check"] in ("random numbers", "golden verdicts")]
        if verb == "merge":
            answer["status"] = self.status(arguments[1])
        self.write_json(f"verbs/{name}", answer)

    def exports(self, name, options):
        """A line for each file: a hash of its numbers, and one of the rest."""
        folder = f"exported-{name}"
        done = self.run("export", "six.db", "--best", "20", "--output", folder, *options)
        files = sorted(path for path in (self.work / folder).rglob("*") if path.is_file()) if not done.returncode else []
        lines = [json.dumps(outcome(done))]
        lines += [f"{path.relative_to(self.work / folder)} {' '.join(hashes(path.read_bytes()))}" for path in files]
        self.write(f"exports/{name}.txt", "\n".join(lines) + "\n")

    def certificates(self, catalogue, count):
        copy = f"certified-{catalogue}"
        shutil.copy(self.work / catalogue, self.work / copy)
        self.run("certify", copy, "--best", str(count), "--json")
        with sqlite3.connect(self.work / copy) as database:
            rows = database.execute("SELECT draw, certified_deg, asked_deg, ended, place, intervals, hash, proof "
                                    "FROM certificate ORDER BY draw").fetchall()
        lines = [" ".join(map(str, [*row[:-1], hashlib.sha256(row[-1]).hexdigest()])) for row in rows]
        self.write(f"certificates/{Path(catalogue).stem}.txt", "\n".join(lines) + "\n")

    def page(self, name, file):
        self.run("report", file, "--output", f"{name}.html")
        data = re.search(r'<script type="application/json" id="report-data">(.*?)</script>',
                         (self.work / f"{name}.html").read_text(), re.S)
        self.write_json(f"page/{name}", json.loads(data[1]))


def outcome(done):
    """The exit code, and what was said where it is no success."""
    return {"exit": done.returncode, **({"error": done.stderr} if done.returncode else {})}


def stripped(answer):
    """A document without the keys that are no answer."""
    if isinstance(answer, dict):
        return {key: stripped(value) for key, value in answer.items() if key not in STRIPPED}
    return [stripped(value) for value in answer] if isinstance(answer, (list, tuple)) else answer


NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def hashes(content):
    """One of the numbers in a text and one of the rest; one of all bytes where it is no text."""
    try:
        content.decode()
    except ValueError:
        return [hashlib.sha256(content).hexdigest()]
    # Styles and scripts of a page are no answers.
    content = re.sub(rb"<(style|script)\b.*?</\1>", b"", content, flags=re.S)
    parts = b"\n".join(NUMBER.findall(content)), NUMBER.sub(b"#", content)
    return [f"{what}:{hashlib.sha256(part).hexdigest()}" for what, part in zip(("numbers", "words"), parts)]


def lines_of(table):
    return [(name, shlex.split(rest)) for name, rest in (line.split(None, 1) for line in table.strip().splitlines())]


def changed(campaign, **changes):
    """A campaign with some keys of its parts replaced."""
    return {**campaign, **{part: {**campaign.get(part, {}), **keys} for part, keys in changes.items()}}


def campaigns(options):
    """Name, campaign and options of search of each campaign that is run."""
    draws = str(round(MILLION * options.draws_scale))
    shipped = {path.stem: json.loads(path.read_text()) for path in sorted((SOURCE / "search/campaigns").glob("*.json"))}
    small = shipped["miura-4x4"]
    for name, campaign in shipped.items():
        method = campaign.get("search", {}).get("method", "plain")
        if method == "splitting" and (options.long or name == "miura-6x6-flat"):
            yield name, campaign, ["--populations", "2"]
        elif method == "splitting":
            easier = {"deploys_from_deg": 130 if "10x10" in name else 160}
            yield f"small-{name}", changed(campaign, search=SMALL, accept=easier), ["--populations", "2"]
        elif method == "optimise":  # one in some 2600 draws is a start
            yield name, {**campaign, "stop": {"draws": 55000}}, []
        else:
            yield name, {**campaign, "stop": {}}, ["--draws", draws]
    for name, changes in OTHERS.items():
        yield f"4x4-{name}", changed(small, **changes), ["--draws", "5000"]
    for name, search in ASCENTS.items():  # four in ten draws are starts
        yield f"4x4-best-{name}", changed(small, search={"method": "optimise", **search}), ["--draws", "50"]


def make_inputs(recorder):
    """Writes the folder's campaigns, patterns and catalogues."""
    work = recorder.work
    (work / "searched").mkdir()
    for folder in ("patterns", "campaigns"):
        shutil.copytree(SOURCE / "search" / folder, work / folder)
    small = json.loads((work / "campaigns/miura-4x4.json").read_text())
    rare = changed(small, search={"method": "splitting", "particles": 50, "sweeps": 3, "first_draws": 500},
                   accept={"deploys_from_deg": 175})
    better = changed(small, search={"method": "optimise", "from_deg": 36})
    for name, campaign in (("rare", {**rare, "name": "rare", "stop": {}}), ("better", {**better, "name": "better"}),
                           ("wrong", changed(small, pattern={"rows": 5}, accept={"deploys_from_deg": 150.5}))):
        (work / f"{name}.json").write_text(json.dumps(campaign))
    for catalogue, campaign, options in (
            ("small.db", "campaigns/miura-4x4.json", "--draws 1200 --unit-draws 500"),
            ("six.db", "campaigns/miura-6x6.json", "--draws 100000"),
            ("part-1.db", "campaigns/miura-4x4.json", "--range 0:3000 --unit-draws 500"),
            ("part-2.db", "campaigns/miura-4x4.json", "--range 2000:5000 --unit-draws 500"),
            ("rare.db", "rare.json", "--populations 2"), ("better.db", "better.json", "--draws 20")):
        done = recorder.search(campaign, catalogue, *options.split())
        if done.returncode:
            sys.exit(f"{catalogue}: {done.stderr.strip()}")
    recorder.run("construct", "patterns/table1.json", "--amplitude", "4", "--output", "made.json")


def record(options):
    program, target = Path(options.program).resolve(), Path(options.directory).resolve()
    if not os.access(program, os.X_OK):
        sys.exit(f"{options.program}: is no program that can be run; name a built misalign")
    if target.exists() and any(target.iterdir()):
        sys.exit(f"{options.directory}: is there already (the answers of two programs would mix); name a new directory")
    target.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(PROCESSES) as pool:
        recorder = Recorder(program, target, Path(folder))
        verbs = set(re.findall(r"^  ([a-z]+)  ", recorder.run("--help").stdout.split("Verbs:")[1].split("Options:")[0], re.M))
        stress = shutil.which("ccx") is not None
        recorder.write("settings.txt", f"draws-scale {options.draws_scale}\nlong {options.long}\nccx {stress}\n")
        make_inputs(recorder)
        draws = {"{draw}": "small.db", "{six}": "six.db", "{better}": "better.db"}
        draws = {word: str(recorder.first_candidate(catalogue)) for word, catalogue in draws.items()}
        cases = [(name, [draws.get(word, word) for word in words]) for name, words in lines_of(CASES)
                 if stress or words[0] != "stress"]
        cases += [(f"config-{path.stem}", ["config", "--check", f"campaigns/{path.name}"])
                  for path in sorted((SOURCE / "search/campaigns").glob("*.json"))]
        formats = re.search(r"--format (\S+\|\S+)", recorder.run("export", "--help").stdout)[1].split("|")
        exports = {**{name: ["--format", name] for name in formats}, **dict(lines_of(EXPORTS))}
        jobs = [pool.submit(recorder.campaign, name, campaign, *words) for name, campaign, words in campaigns(options)]
        jobs += [pool.submit(recorder.certificates, *part) for part in CERTIFIED.items()]
        jobs += [pool.submit(recorder.case, *case) for case in cases]
        jobs += [pool.submit(recorder.exports, *export) for export in exports.items()]
        jobs += [pool.submit(recorder.page, *page) for page in (("six", "six.db"), ("table1", "patterns/table1.json"))]
        for job in jobs:
            job.result()
    missing = verbs - {words[0] for name, words in lines_of(CASES)} - set(NO_ANSWER)
    for verb in sorted(missing):
        print(f"{verb}: no case in CASES asks this verb for an answer", file=sys.stderr)
    return 1 if missing else 0


def holds_numbers(value):
    if isinstance(value, (dict, list)):
        return any(map(holds_numbers, value.values() if isinstance(value, dict) else value))
    return bool(numbers_of(value)) if isinstance(value, str) else True


def numbers_of(text):
    """The words of a text that have a digit in them: numbers, hashes, encoded arrays."""
    return [word.strip(".,;:()") for word in text.split() if re.search(r"\d", word)]


def differences(a, b, place):
    """Yields of each difference of two documents whether numbers differ, where, and both values."""
    if isinstance(a, dict) and isinstance(b, dict):
        for key in sorted(a.keys() | b.keys()):
            there = f"{place}.{key}"
            if key in a and key in b:
                yield from differences(a[key], b[key], there)
            else:  # a new key changes no answer, one that is gone does
                yield key in a and holds_numbers(a[key]), there, a.get(key, "nothing"), b.get(key, "nothing")
    elif isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            yield True, f"{place}.length", len(a), len(b)
        for index, (one, other) in enumerate(zip(a, b)):
            yield from differences(one, other, f"{place}[{index}]")
    elif isinstance(a, str) and isinstance(b, str):
        if a != b:
            yield numbers_of(a) != numbers_of(b), place, a, b
    elif a != b or isinstance(a, bool) != isinstance(b, bool):
        yield True, place, a, b


def line_differences(a, b):
    for number, (one, other) in enumerate(itertools.zip_longest(a.splitlines(), b.splitlines()), 1):
        if one != other:
            words = [re.sub(r"words:\w+", "", line or "") for line in (one, other)]
            yield numbers_of(words[0]) != numbers_of(words[1]), f"line {number}", one, other


def compare(options):
    folders = [Path(options.directory_a), Path(options.directory_b)]
    for folder in folders:
        if not (folder / "settings.txt").exists():
            sys.exit(f"{folder}: holds no answers (settings.txt is not there); same_answers.py record writes them")
    settings = [(folder / "settings.txt").read_text().split("\n") for folder in folders]
    if settings[0] != settings[1]:
        sys.exit(f"recorded with other settings: {', '.join(settings[0])} and {', '.join(settings[1])}")
    names = sorted({str(path.relative_to(folder)) for folder in folders for path in folder.rglob("*") if path.is_file()})
    counts = {"numbers": 0, "words": 0}
    for name in names:
        paths = [folder / name for folder in folders]
        if not all(path.exists() for path in paths):
            found = [(not paths[1].exists(), "the file", *(["there" if path.exists() else "missing" for path in paths]))]
        else:
            texts = [path.read_text() for path in paths]
            found = [] if texts[0] == texts[1] else \
                list(differences(*map(json.loads, texts), "$")) if name.endswith(".json") else list(line_differences(*texts))
        for what, wanted in (("numbers", True), ("words", False)):
            these = [difference for difference in found if difference[0] == wanted]
            if these:
                counts[what] += 1
                _, place, one, other = these[0]
                print(f"{what}: {name}: {place}: {short(one)} | {short(other)}"
                      + (f" (and {len(these) - 1} more)" if len(these) > 1 else ""))
    print(f"{len(names)} files; numbers differ in {counts['numbers']}, words in {counts['words']}")
    return 1 if counts["numbers"] else 0


def short(value):
    text = value if isinstance(value, str) else json.dumps(value)
    return text if len(text) <= 160 else f"{text[:160]} ..."


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(required=True)
    verb = verbs.add_parser("record", help="write the answers of PROGRAM into the new directory DIR")
    verb.add_argument("program")
    verb.add_argument("directory")
    verb.add_argument("--draws-scale", type=float, default=0.2, help="draws of each plain campaign, in millions [%(default)s]")
    verb.add_argument("--long", action="store_true",
                      help="a million, and two populations of every shipped splitting campaign: hours")
    verb.set_defaults(action=record)
    verb = verbs.add_parser("compare", help="say where the answers in two directories differ")
    verb.add_argument("directory_a")
    verb.add_argument("directory_b")
    verb.set_defaults(action=compare)
    options = parser.parse_args()
    if getattr(options, "long", False):
        options.draws_scale = 1.0
    return options.action(options)


if __name__ == "__main__":
    sys.exit(main())
