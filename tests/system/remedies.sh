# The remedies of failing cards: each one's pattern file meets its requirement, and breaks none that was met.
. "$(dirname "$0")/lib.sh"
patterns=$source_dir/search/patterns
cat > apply.py << 'END'
import json
import subprocess
import sys

program, name = sys.argv[1:3]


def card(path, *options):
    ended = subprocess.run([program, "card", path, "--trials", "200", "--json", *options], capture_output=True, text=True)
    assert ended.returncode in (0, 6), (path, options, ended.stderr)
    made = json.loads(ended.stdout)
    assert (ended.returncode == 0) == made["passes"], path
    return made


def met(made):
    return {line["key"] for line in made["lines"] if line["passes"]}


failing = card(name)
lacks = {line["key"] for line in failing["lines"] if line["passes"] is False}
assert lacks, "nothing fails"
prices = 0
for k, remedy in enumerate(failing["remedies"]):
    path = f"remedy-{k}-{name}"
    with open(path, "w", encoding="utf-8") as file:
        json.dump(remedy["pattern"], file)
    changed = card(path, "--no-remedies")
    assert remedy["for"] in lacks, remedy["for"]
    asked = {line["key"] for line in changed["lines"] if line["passes"] is not None}
    assert remedy["for"] in met(changed) or remedy["for"] not in asked, (remedy["what"], remedy["for"])
    assert met(failing) & asked <= met(changed), (remedy["what"], met(failing) - met(changed))
    assert changed["passes"] == remedy["meets_all"], remedy["what"]
    found = {line["what"]: line["found"] for line in changed["lines"]}
    prices += len(remedy["prices"])
    assert all(price["what"] in found for price in remedy["prices"]), remedy["prices"]
print(len(failing["remedies"]), len({remedy["for"] for remedy in failing["remedies"]}), len(lacks), prices)
END
# fails NAME BASE DESIGN AT_LEAST: a card that fails, with remedies for so many of its requirements.
fails() {
  python3 - "$2" "$3" > "$1.json" << 'END' || fail "$1: its file"
import json, sys
pattern = json.load(open(sys.argv[1]))
pattern["design"] = json.loads(sys.argv[2])
print(json.dumps(pattern))
END
  python3 apply.py "$program" "$1.json" > counts 2> err || { fail "$1: $(tail -1 err)"; return; }
  read -r remedies mended lacking prices < counts
  echo "$1: $remedies remedies, of $mended of $lacking requirements; $prices prices"
  [ "$mended" -ge "$4" ] || fail "$1: $mended of $lacking requirements have remedies"
}
# One spring a hole, relaxed flat, is the least that every sheet here has.
one='"on": "one_a_hole"'
echo '{ "family": "miura", "rows": 4, "columns": 4 }' > four.json
"$program" construct four.json --rim --amplitude 2 --output made.json > /dev/null || fail "construct"
fails crossing made.json '{"from_deg": 60, "thickness_mm": 1}' 1
fails thick made.json "{\"from_deg\": 100, \"thickness_mm\": 6, \"springs\": {$one}}" 1
fails sticky made.json "{\"from_deg\": 100, \"thickness_mm\": 2, \"springs\": {$one}, \"hinges\": {\"friction_n_mm_per_mm\": 0.02}}" 2
fails slow made.json "{\"from_deg\": 90, \"thickness_mm\": 2, \"springs\": {$one, \"preload_n\": 0.2}, \"hold_flat\": true, \"hinges\": {\"friction_n_mm_per_mm\": 0.001}}" 1
fails loose made.json "{\"from_deg\": 90, \"springs\": {$one, \"preload_n\": 1}}" 1
fails soft made.json "{\"from_deg\": 90, \"springs\": {$one}, \"material\": {\"name\": \"PLA\", \"e_gpa\": 3.5, \"strength_mpa\": 0.8}}" 1
fails weak made.json "{\"from_deg\": 90, \"springs\": {$one, \"largest_force_n\": 20, \"stroke_limit\": 0.01}}" 2
fails pinned made.json "{\"from_deg\": 90, \"springs\": {$one}, \"hinges\": {\"pin_friction_mm\": 0.3}}" 3
fails coarse "$patterns/table1.json" "{\"from_deg\": 150, \"miscut_mm\": 0.5, \"springs\": {$one}}" 2
fails beyond "$patterns/table1.json" "{\"from_deg\": 165, \"springs\": {$one}}" 2
fails hard made.json "{\"from_deg\": 90, \"springs\": {$one}, \"wanted\": {\"landing_deg_per_s\": 3000}}" 1
finish
