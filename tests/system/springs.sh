# Springs to buy: a table gives a choice, with which the card passes and the energy falls all the way; bad tables are refused.
. "$(dirname "$0")/lib.sh"
cp "$source_dir/search/patterns/table1.json" table1.json
echo '{ "family": "miura", "rows": 4, "columns": 4 }' > four.json
"$program" construct four.json --rim --amplitude 2 --output made.json > /dev/null || fail "construct"
cat > shop.csv << 'END'
# kind, price of one
name,rate_n_per_mm,free_mm,longest_mm,wire_mm,outer_mm,price,initial_n
E-030,0.05,30,75,0.3,3,0.45,0.1
"E-040, zinc",0.12,40,90,0.4,3.5,0.60,0.2
E-100,0.6,30,60,0.7,4,0.40,0.6
END
cat > drive.py << 'END'
"""Checks a bought sheet from its own files: energies and lengths by coordinates of `misalign fold`, the card's margin."""
import csv
import json
import subprocess
import sys

program, bought, answer, table, from_deg = sys.argv[1:6]
from_deg = float(from_deg)


def said(*arguments):
    ended = subprocess.run([program, *arguments], capture_output=True, text=True)
    assert ended.returncode in (0, 6), (arguments, ended.stderr)
    return json.loads(ended.stdout)


with open(answer, encoding="utf-8") as file:
    choice = json.load(file)["bought"]
with open(table, encoding="utf-8") as file:
    rows = {row["name"]: row for row in csv.DictReader(line for line in file if not line.startswith("#"))}
assert choice["drives"] and choice["is_proven"]

# Every spring within its table's lengths; the price is the sum, the groups hold every spring once.
price, lines = 0.0, {}
for spring in choice["springs"]:
    row = rows[spring["type"]]
    free, longest = float(row["free_mm"]), float(row["longest_mm"])
    shortest_used, longest_used = spring["least_mm"] - spring["link_mm"], spring["most_mm"] - spring["link_mm"]
    assert spring["link_mm"] == round(spring["link_mm"]) and spring["link_mm"] >= 5, spring
    assert free <= shortest_used + 1e-6 and longest_used <= longest + 1e-6, spring
    force = float(row["initial_n"]) + float(row["rate_n_per_mm"]) * (longest_used - free)
    assert abs(force - spring["largest_force_n"]) < 1e-6 * force, (force, spring)
    price += float(row["price"])
    lines[spring["diagonal"]] = (row, spring)
assert abs(price - choice["price"]) < 1e-9 * price
grouped = [diagonal for group in choice["groups"] for diagonal in group["diagonals"]]
assert sorted(grouped) == sorted(lines), grouped
assert all(group["count"] == len(group["diagonals"]) for group in choice["groups"])

# Energy of the shop's springs by lengths between folded vertices, in steps of 0.1 degrees.
folded = said("fold", bought, "--to", str(from_deg), "--step", "0.1", "--json")
lengths = {f"{d['from']}-{d['to']}": [d["flat_mm"], *d["length_mm"]] for d in folded["diagonals"]}
energies = []
for k in range(len(folded["samples_deg"]) + 1):
    energy = 0.0
    for diagonal, (row, spring) in lines.items():
        longer = lengths[diagonal][k] - spring["link_mm"] - float(row["free_mm"])
        assert longer > -1e-6, (diagonal, k)
        energy += float(row["initial_n"]) * longer + float(row["rate_n_per_mm"]) / 2 * longer**2
    energies.append(energy)
assert all(after > before for before, after in zip(energies, energies[1:])), "the energy does not fall all the way"
assert abs(folded["samples_deg"][0] - 0.1) < 1e-9 and folded["samples_deg"][-1] >= from_deg - 0.11

# The energy that deploy takes of the filling falls by as much between its rows.
motion = said("deploy", bought, "--from", str(from_deg), "--json")
assert motion["outcome"] in ("passed_flat", "flat"), motion["outcome"]
at = [0.0, *folded["samples_deg"]]
rows_checked = 0
previous = None
for deg, energy in zip(motion["pilot_deg"], motion["energy_n_mm"]):
    k = round(deg / 0.1)
    if deg < 0.4 or abs(deg - 0.1 * k) > 1e-6 or k >= len(at):
        continue
    assert abs(at[k] - deg) < 1e-6
    if previous is not None:
        fall, fall_by_lengths = previous[1] - energy, energies[previous[0]] - energies[k]
        # Lengths are those of solved states, energies of a motion that closes loops to 1e-9.
        assert fall > 0 and abs(fall - fall_by_lengths) < 1e-5 * energies[-1] + 1e-3 * fall, (deg, fall, fall_by_lengths)
        rows_checked += 1
    previous = (k, energy)
assert rows_checked > 100, rows_checked

# The card's own margin is that of the choice, and it passes.
card = said("card", bought, "--hold-flat", "--trials", "100", "--no-remedies", "--json")
found = {line["key"]: line for line in card["lines"]}
assert card["passes"], [line["key"] for line in card["lines"] if line["passes"] is False]
assert found["static_margin"]["passes"] and found["energy_falls_from_deg"]["passes"]
assert abs(found["static_margin"]["found"] - choice["static_margin"]) < 1e-6 * (1 + choice["static_margin"])
print(f"{len(lines)} springs, {len(choice['groups'])} groups, price {choice['price']:g}, static margin "
      f"{found['static_margin']['found']:.3g}, {rows_checked} rows of the motion")
END
# buys NAME FROM ARGUMENT...: a sheet with springs of the shop, checked.
buys() {
  "$program" actuators "$1.json" --buy --springs shop.csv --from "$2" "${@:3}" --output bought.json --json > answer.json 2> err ||
    { fail "$1: $(cat err)"; return; }
  python3 drive.py "$program" bought.json answer.json shop.csv "$2" > words 2> err || { fail "$1 ${*:3}: $(tail -1 err)"; return; }
  echo "$1 ${*:3}: $(cat words)"
}
buys table1 120 --friction 0.000002 --thickness 2
buys table1 120 --friction 0.000016 --thickness 2 --least price --link-step 2
buys made 90 --friction 0.00002 --thickness 2

# The text names what to order; common springs need no file; nothing is written where nothing drives.
"$program" actuators table1.json --buy --springs shop.csv --from 120 > words || fail "text"
grep -q 'proven best' words && grep -q 'E-' words && grep -q 'link mm' words || fail "words: $(cat words)"
"$program" actuators table1.json --buy --from 120 --json > answer.json || fail "common springs"
json_test answer.json "j ->> '\$.bought.drives' AND json_array_length(j, '\$.bought.way.springs') = json_array_length(j, '\$.bought.springs')" ||
  fail "common springs: $(head -c 300 answer.json)"
"$program" actuators table1.json --buy --from 120 --friction 1 --output none.json > words 2> err
[ $? = 6 ] && grep -q 'none.json: is not written' err && [ ! -e none.json ] || fail "nothing drives: $(cat err)"
grep -q 'no springs of the table drive it' words || fail "words of nothing: $(cat words)"

# refused CODE WORDS ARGUMENT...
refused() {
  "$program" actuators table1.json "${@:3}" > out 2> err
  [ $? = "$1" ] || fail "exit code of ${*:3}"
  grep -q -- "$2" err && [ ! -s out ] || fail "no '$2' for ${*:3}: $(cat err)"
}
sed 's/^E-030,0.05/E-030,soft/' shop.csv > bad.csv
refused 3 'bad.csv: line 3: rate_n_per_mm = soft (is no number); write its rate' --buy --springs bad.csv
refused 3 'no such file' --buy --springs missing.csv
echo 'name,rate' > bad.csv
refused 3 'bad.csv: line 1: rate (is no column of springs; did you mean rate_n_per_mm' --buy --springs bad.csv
refused 2 '--springs' --springs shop.csv
refused 2 '--link-step' --buy --link-step 0
refused 2 '--least-link' --buy --least-link=-1
refused 2 '--least' --buy --least weight
refused 2 '--buy' --buy --choose
refused 2 '--friction: is overcome by springs that are chosen' --friction 0.1
refused 2 'lies\|folds' --buy --from 179
finish
