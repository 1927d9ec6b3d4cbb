# Wishes become designs that meet them: the design's own card says so, a stopped run goes on to the same end, and
# threads change nothing.
. "$(dirname "$0")/lib.sh"
cat > wish.json << 'END'
{ "family": "miura", "rows": 4, "columns": 4,
  "design": { "from_deg": 90, "thickness_mm": 2, "miscut_mm": 0.05, "hinges": { "friction_n_mm_per_mm": 0.001 },
              "material": "birch plywood" },
  "free": { "amplitude_mm": [0.5, 3], "thickness_mm": { "of": [1, 2, 3] }, "stiffness_n_per_mm": [0.2, 20],
            "preload_n": [0, 10], "rim": true, "hold_flat": true, "one_a_hole": true } }
END
quick="--trials 100 --draws 2000"
"$program" design wish.json $quick --jobs 1 --output made > text 2> err || fail "no design: $(tail -3 text err)"
grep -q "designs meet all requirements" text || fail "no table"
"$program" card made/best.json --trials 100 --no-remedies > card 2>&1 || fail "its card fails: $(head -3 card)"
grep -q "meets all" card || fail "the card's verdict"
for file in best.json best-card.html best-kit.html tried.json; do [ -s "made/$file" ] || fail "no $file"; done
ls made/best-kit*.dxf > /dev/null || fail "no kit"
# Two threads, and a run that is killed after its first steps.
"$program" design wish.json $quick --jobs 2 --json > two.json 2> err || fail "two threads: $(cat err)"
"$program" design wish.json $quick --jobs 1 --output killed > /dev/null 2>&1 &
running=$!
for _ in $(seq 600); do [ -s killed/tried.json ] && break; sleep 0.1; done
kill -KILL $running 2> /dev/null
wait $running 2> /dev/null
[ -s killed/tried.json ] || fail "no step was kept"
"$program" design wish.json $quick --jobs 1 --output killed > again 2>&1 || fail "it does not go on: $(cat again)"
cmp -s made/best.json killed/best.json || fail "a run that went on ends in another design"
cmp -s made/tried.json killed/tried.json || fail "a run that went on tried other designs"
python3 - << 'END' || fail "threads change the designs"
import json
two = json.load(open("two.json"))
made = json.load(open("made/best.json"))
assert two["tries"][0]["pattern"] == made, "another best"
logged = [tried for tries in json.load(open("made/tried.json"))["steps"].values() for tried in tries]
assert all(tried in logged for tried in two["tries"]), "other tries"
scores = [tried["score"] for tried in two["tries"] if tried["pattern"]]
assert scores == sorted(scores, reverse=True), scores
assert two["card"]["passes"] and all(tried["pattern"] or tried["why"] for tried in two["tries"])
design, free = made["design"], json.load(open("wish.json"))["free"]
assert design["thickness_mm"] in free["thickness_mm"]["of"], design
shifts = [abs(shift) for pair in made["pattern"]["displacements_mm"].values() for shift in pair]
assert max(shifts) <= free["amplitude_mm"][1] * (1 + 1e-9), max(shifts)
END
# What cannot be met ends in the nearest design, and in what is in its way.
sed 's/"friction_n_mm_per_mm": 0.001/"friction_n_mm_per_mm": 5/' wish.json > sticky.json
"$program" design sticky.json $quick > nearest 2> err
[ $? -eq 6 ] || fail "a wish that cannot be met: $(tail -1 err)"
grep -q "0 of .* designs meet" nearest && grep -q "FAIL" nearest || fail "no nearest design"
# Input that is no wish.
refuses() { # NAME WORDS: wish NAME is refused with a sentence.
  "$program" design "$1" --output none > out 2> err
  [ $? -eq "$3" ] || fail "$1: exit code $?"
  grep -q "$2" err || fail "$1: $(cat err)"
  [ ! -e none/best.json ] || fail "$1: something was written"
}
sed 's/"free"/"fre"/' wish.json > unfree.json
refuses unfree.json "free (is missing)" 3
sed 's/"from_deg": 90, //' wish.json > angleless.json
refuses angleless.json "no angle of use" 3
sed 's/"rim": true/"rims": true/' wish.json > misspelt.json
refuses misspelt.json "rims" 3
"$program" design sticky.json $quick --output made > out 2> err
[ $? -eq 2 ] && grep -q "another wish" err || fail "another wish in the same folder: $(cat err)"
finish
