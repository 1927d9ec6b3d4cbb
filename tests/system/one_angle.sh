# One angle of use: every verb that knows the design's takes it, and says the card's numbers at that angle.
. "$(dirname "$0")/lib.sh"
design='"design": { "from_deg": 120, "play_mm": 0.001, "miscut_mm": 0.02, "thickness_mm": 0.5,
  "material": { "name": "steel", "e_gpa": 210, "strength_mpa": 300 },
  "springs": { "stiffness_n_per_mm": 5, "stroke_limit": 0.1, "largest_force_n": 900 },
  "hinges": { "friction_n_mm_per_mm": 0.00001, "pin_friction_mm": 0.05 } }'
sed "s|\"holes\"|${design//$'\n'/ }, \"holes\"|" "$source_dir/search/patterns/table1.json" > used.json
cat > ask.py << 'END'
import json
import re
import subprocess
import sys

program = sys.argv[1]
ANGLE = 120.0
# A verb, its options, the place of the angle of use in its JSON; and its numbers: the card's key, and where they are.
VERBS = [
    ("construct", [], "at_deg", {}),
    ("optimise", ["--steps", "1"], "used_from_deg", {}),
    ("optimise", ["--steps", "1"], "asked_deg", {}),
    ("optimise", ["--steps", "1"], "from_deg", {}),
    ("certify", [], "certificate.asked_deg", {"certified_deg": "certificate.certified_deg"}),
    ("tolerance", ["--amplitude", "0.02", "--trials", "100"], "threshold_deg", {"yield": "from_threshold.share"}),
    ("tolerance", ["--backlash", "0.001", "--trials", "100"], "one_way.to_deg", {"play_mm": "largest.backlash_mm"}),
    ("actuators", [], "from_deg", {"largest_force_n": "forces"}),
    ("contact", ["--diameter", "5"], "from_deg", {"thickness_mm": "thickness.largest_mm", "spring_clearance_mm": "springs.springs.closest.clear_mm"}),
    ("deploy", [], "from_deg", {"largest_stress_mpa": "bent.largest_stress_mpa", "static_margin": "bent.static_margin",
                                "pin_margin_at_ends": "pins.at_ends.critical_mm"}),
    ("report", [], "details.0.from_deg", {}),
    ("card", ["--trials", "100", "--no-remedies"], "from_deg", {}),
]
# What a verb's number is made of before it is the card's.
MADE = {
    "largest_force_n": lambda forces: max(abs(one["force_n"]) for one in forces),
    "pin_margin_at_ends": lambda critical_mm: critical_mm / 0.05 - 1,
}
# Verbs with a design, whose angle is another or not in their JSON: shape (its sheet's), export (files), stress (CalculiX).
OTHERS = {"shape", "export", "stress"}


def run(*words):
    return subprocess.run([program, *words], capture_output=True, text=True)


def at(json_value, path):
    for key in path.split("."):
        json_value = json_value[int(key) if isinstance(json_value, list) else key]
    return json_value


listed = re.findall(r"^  ([a-z]+)  ", run("--help").stdout, re.M)
designed = {verb for verb in listed if "the design's" in run(verb, "--help").stdout}
assert designed == {verb for verb, *_ in VERBS} | OTHERS, designed ^ ({verb for verb, *_ in VERBS} | OTHERS)
card = {line["key"]: line["found"] for line in json.loads(run("card", "used.json", "--json", "--trials", "100", "--no-remedies").stdout)["lines"]}
for verb, options, place, numbers in VERBS:
    answer = run(verb, "used.json", *options, "--json")
    assert answer.returncode in (0, 6), (verb, answer.stderr)
    answer = json.loads(answer.stdout)
    assert at(answer, place) == ANGLE, (verb, place, at(answer, place))
    for key, path in numbers.items():
        number = MADE.get(key, lambda value: value)(at(answer, path))
        assert abs(number - card[key]) <= 1e-12 * abs(number), (verb, key, number, card[key])
# The better sheet's stroke is that of its own card.
better = json.loads(run("optimise", "used.json", "--steps", "1", "--output", "better.json", "--json").stdout)
with_card = {line["key"]: line["found"] for line in json.loads(run("card", "better.json", "--json", "--trials", "1", "--no-remedies").stdout)["lines"]}
assert better["stroke"] == with_card["stroke"], (better["stroke"], with_card["stroke"])
# A limit of the optimisation is a requirement of its card.
limits = ["--subject-to", "thickness_mm >= 0.55", "--subject-to", "stroke_max <= 0.09"]
ended = run("optimise", "used.json", "--steps", "1", *limits, "--output", "limited.json")
if ended.returncode == 0:
    with open("limited.json", encoding="utf-8") as file:
        design = json.load(file)["design"]
    assert (design["thickness_mm"], design["springs"]["stroke_limit"]) == (0.55, 0.09), design
else:
    sys.exit(ended.stderr)
END
python3 ask.py "$program" > said 2>&1 || fail "$(tail -3 said)"
"$program" export used.json --format svg --kit --guide --output kit > names 2>&1 || fail "export: $(cat names)"
grep -q "120" kit/used-kit.html || fail "the guide's angle"
finish
