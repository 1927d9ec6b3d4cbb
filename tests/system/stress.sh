# Elastic panels by CalculiX: a 4 x 4 sheet of stiff panels goes flat, one of the paper's for its first steps.
. "$(dirname "$0")/lib.sh"

table1=$source_dir/search/patterns/table1.json
# shellcheck disable=SC2123
(PATH=/nowhere; "$program" stress "$table1" --output none > out 2> err
 echo $? > code)
[ "$(cat code)" = 1 ] || fail "without ccx: exit code $(cat code)"
grep -q "there is no ccx in PATH" err || fail "without ccx: $(cat err)"
[ -e none ] && fail "without ccx a directory was made"
"$program" stress "$table1" --from 157 --output none > out 2> err
[ $? = 2 ] && grep -q "fold limit at 156.34" err || fail "beyond the fold limit: $(cat err)"
"$program" stress "$table1" --rest-deg 157 --output none > out 2> err
[ $? = 2 ] && grep -q -e "--rest-deg 157: table1 has its fold limit at 156.34" err || fail "rest beyond the fold limit: $(cat err)"
cp "$table1" table1.dat
if command -v ccx > /dev/null; then
  "$program" stress table1.dat --output . > out 2> err
  [ $? = 2 ] && cmp -s "$table1" table1.dat || fail "a file that is read would be replaced: $(cat err)"
fi

# One that stands in for ccx, and does what ccx should not: the sheet stays as it is, and so do its stresses.
mkdir fake
cat > fake/ccx << 'END'
#!/usr/bin/env python3
import os, sys, time
kind, job = os.environ["FAKE"], sys.argv[sys.argv.index("-i") + 1]
nodes, corners, elements, into = {}, [], {}, None
for line in open(job + ".inp"):
    if line[0] == "*":
        into = {"*NODE, NSET=NALL\n": "nodes", "*NSET, NSET=CORNERS\n": "corners"}.get(
            line, "elements" if line.startswith("*ELEMENT, TYPE=S8R") else None)
    elif into == "nodes":
        number, *at = line.split(",")
        nodes[int(number)] = [float(x) for x in at]
    elif into == "corners":
        corners += [int(x) for x in line.split(",")]
    elif into == "elements":
        number, *of = [int(x) for x in line.split(",")]
        elements[number] = of
far = 150000000 if kind == "far" else 0
dat, frd = open(job + ".dat", "w"), open(job + ".frd", "w")
open("spooles.out", "w").close()  # as ccx does
with open(os.environ["FAKE_SAYS"], "w") as said:
    print(os.getcwd(), os.getpid(), file=said)
print("    1C\n    2C", file=frd)
for number, at in nodes.items():
    print(" -1%10d" % (number + far) + "".join("%12.5E" % x for x in at), file=frd)
print(" -3\n    3C", file=frd)
for number, of in elements.items():
    print(" -1%10d    4    0    1\n -2" % number + "".join("%10d" % (x + far) for x in of), file=frd)
print(" -3", file=frd)
for k in range(1, 1000000 if kind in ("slow", "never") else 4):
    time.sleep(0 if kind == "far" else 0.25)
    if kind == "never":
        continue
    t = 0.01 * k
    print("\n displacements (vx,vy,vz) for set CORNERS and time  %.7E\n" % t, file=dat)
    for node in corners:
        x = "           NaN" if kind == "nan" and k == 2 or kind == "nan-at-once" else "%14.6E" % 0
        print("%10d" % node + 3 * x, file=dat)
    for energy in ("internal", "kinetic"):
        print("\n total %s energy for set PANELS and time  %.7E\n\n        1.000000E+00" % (energy, t), file=dat)
    print("  100CL  101 %.5E\n -4  STRESS      6    1" % t, file=frd)
    for node in nodes:
        x = "************" if kind == "stars" and k == 2 else "%12.5E" % (10 + k)
        print(" -1%10d" % (node + far) + x + 5 * " 0.00000E+00", file=frd)
    print(" -3", file=frd)
    dat.flush()
    frd.flush()
END
chmod +x fake/ccx
export FAKE_SAYS=$PWD/fake-says
faked() {  # KIND OUTPUT
  FAKE=$1 PATH=$PWD/fake:$PATH "$program" stress "$table1" --output "$2" > out 2> err
}
in_result() { [ "$(sqlite3 :memory: "SELECT $2 FROM (SELECT readfile('$1/table1-stress.json') AS j)")" = 1 ] || fail "$1: $2: $(cat out err)"; }
shown() {
  "$program" report "$table1" --stress "$1/table1-stress.json" --output "$1.html" > out 2> err ||
    fail "no report of $1: $(cat err)"
}

# It runs from an absolute directory of PATH alone, in a fresh directory, and follows no link.
mkdir theirs
printf '#!/bin/sh\ntouch %s/ran\n' "$PWD" > theirs/ccx
cp theirs/ccx ccx
chmod +x ccx theirs/ccx
for relative in . theirs "" ./theirs; do
  # shellcheck disable=SC2123
  (PATH=$relative:/nowhere; "$program" stress "$table1" --output theirs > out 2> err
   echo $? > code)
  [ "$(cat code)" = 1 ] && grep -q "there is no ccx in PATH" err || fail "PATH=$relative: $(cat code err)"
done
[ -e ran ] && fail "a ccx of a relative directory was run"
for ending in log dat frd inp sta; do
  echo mine > mine-$ending
  ln -s "$PWD/mine-$ending" theirs/table1.$ending
done
faked good theirs || fail "a good run: $(cat err)"
for ending in log dat frd inp sta; do
  [ "$(cat mine-$ending)" = mine ] || fail "the link of table1.$ending was followed"
done
[ -f theirs/table1.dat ] && [ ! -L theirs/table1.dat ] && [ ! -e theirs/table1.sta ] || fail "files of the run: $(ls -l theirs)"
read -r where _ < fake-says
case $where in
  "$PWD"/theirs/table1.run-*) ;;
  *) fail "it ran in $where" ;;
esac
[ -e "$where" ] && fail "the run's directory stays"
in_result theirs "j ->> 'outcome' = 'time_limit' AND json_array_length(j, '\$.motion.time_s') = 4 AND
  json_array_length(j, '\$.stress.time_s') = 3 AND j ->> '\$.largest_anywhere_mesh_dependent.stress_mpa' = 13"
shown theirs
# What warns of an angle beyond D is no part of the result.
FAKE=good PATH=$PWD/fake:$PATH "$program" stress "$table1" --from 156.3 --json --output beyond > out 2> err ||
  fail "beyond D: $(cat err)"
json_test out "json_valid(j)" && grep -q "^misalign: .*beyond D = 156 deg" err || fail "beyond D: $(head -c 200 out; cat err)"

# Nor that of the result, whose name nobody typed.
mkdir linked
ln -s "$PWD/mine-log" linked/table1-stress.json
faked good linked
[ $? = 2 ] && grep -q "table1-stress.json: is a link" err && [ "$(cat mine-log)" = mine ] || fail "a link for a result: $(cat err)"

# Nor that of the result, whose name nobody typed.
mkdir linked
ln -s "$PWD/mine-log" linked/table1-stress.json
faked good linked
[ $? = 2 ] && grep -q "table1-stress.json: is a link" err && [ "$(cat mine-log)" = mine ] || fail "a link for a result: $(cat err)"

# What is no number ends the motion; what was before it is the result, which a report takes.
faked nan nan || fail "NaN: $(cat err)"
grep -q "not deployed: after 0.0100 s .*; ccx gave up there" out || fail "NaN: $(cat out)"
in_result nan "j ->> 'outcome' = 'failed' AND json_array_length(j, '\$.motion.time_s') = 2"
shown nan
faked stars stars || fail "stars: $(cat err)"
in_result stars "j ->> 'outcome' = 'failed' AND json_array_length(j, '\$.stress.time_s') = 1 AND
  j ->> '\$.largest_anywhere_mesh_dependent.stress_mpa' = 11"
shown stars
faked nan-at-once at-once
[ $? = 1 ] && grep -q "ccx wrote what is no number.*at-once/table1.log is what it said" err || fail "NaN at once: $(cat err)"
[ -e at-once/table1.log ] && [ ! -e at-once/table1-stress.json ] || fail "NaN at once: $(ls at-once)"
# Numbers of nodes take no room.
(ulimit -v 2000000; faked far far) || fail "numbers of nodes: $(cat err)"
in_result far "json_array_length(j, '\$.stress.time_s') = 3 AND j ->> '\$.largest_outside_discs.stress_mpa' = 13"

# Stopped: ccx is gone, and what it had reached is there.
reached() {  # KIND OUTPUT: some increments, if it makes any
  [ -s fake-says ] && { [ "$1" = never ] || [ "$(cat "$2"/table1.run-*/table1.dat 2> /dev/null | grep -c kinetic)" -gt 2 ]; }
}
stopped() {  # SIGNAL KIND OUTPUT
  rm -f fake-says
  FAKE=$2 PATH=$PWD/fake:$PATH "$program" stress "$table1" --output "$3" > out 2> err &
  local run=$!
  eventually "a run under way" reached "$2" "$3"
  kill "-$1" $run
  wait $run
}
stopped TERM slow stopped || fail "stopped: $?, $(cat err)"
grep -q "not deployed: after 0.0.*; stopped there" out || fail "stopped: $(cat out)"
in_result stopped "j ->> 'outcome' = 'stopped' AND json_array_length(j, '\$.motion.time_s') > 2 AND
  j ->> '\$.largest_anywhere_mesh_dependent.stress_mpa' >= 12"
shown stopped
read -r _ pid < fake-says
kill -0 "$pid" 2> /dev/null && fail "ccx goes on"
[ -e stopped/table1.frd ] && ! ls -d stopped/table1.run-* 2> /dev/null || fail "stopped: $(ls stopped)"
stopped INT never early
[ $? = 1 ] && grep -q "ccx was stopped before the end of its first increment; .*early/table1.log" err || fail "stopped at once: $(cat err)"
# On a terminal it says how long it will take at most.
FAKE=good PATH=$PWD/fake:$PATH TERM=xterm script -qec "$program stress $table1 --time-limit 100 --output screened" \
  /dev/null < /dev/null > screen || fail "on a terminal: $(cat screen)"
grep -q "s of at most 100 s: pilot at 36.00 deg, .* left at most" screen || fail "no time that is left: $(cat -v screen)"

if ! command -v ccx > /dev/null; then
  echo "SKIPPED: ccx (calculix-ccx) is not installed"
  finish
fi

"$program" search "$source_dir/search/campaigns/miura-4x4.json" --range 1112:1113 --catalogue a.db \
  --progress none > /dev/null || fail "search"
echo '{ "name": "stiff", "e_gpa": 7000 }' > stiff.json
"$program" stress a.db 1112 --from 6 --stiffness 5000 --material stiff.json --time-step 4e-3 --time-limit 0.2 \
  --output run > out || fail "stress"
result=run/miura-4x4-1112-stress.json
[ "$(tail -1 out)" = "$PWD/$result" ] || fail "the result's name: $(tail -1 out)"
holds() { [ "$(sqlite3 :memory: "SELECT $2 FROM (SELECT readfile('$result') AS j)")" = 1 ] || fail "$1"; }
holds "deployed" "j ->> 'outcome' = 'deployed' AND j ->> 'draw' = 1112 AND j ->> '\$.motion.widest_deg[#-1]' < 5"
grep -q "^deployed: every crease within 5 deg after" out || fail "the text: $(cat out)"
holds "energy only goes away" "j ->> '\$.motion.springs_n_mm[#-1]' + j ->> '\$.motion.bending_n_mm[#-1]' +
  j ->> '\$.motion.kinetic_n_mm[#-1]' < j ->> '\$.motion.springs_n_mm[0]' + j ->> '\$.motion.bending_n_mm[0]' +
  j ->> '\$.motion.kinetic_n_mm[0]'"
holds "stresses" "j ->> '\$.largest_outside_discs.stress_mpa' > 0.1 AND json_array_length(j, '\$.panels') = 14 AND
  j ->> '\$.largest_anywhere_mesh_dependent.stress_mpa' >= j ->> '\$.largest_outside_discs.stress_mpa' AND
  j ->> '\$.largest_outside_discs.stress_mpa' = (SELECT max(value ->> 'outside_discs_mpa') FROM json_each(j, '\$.panels'))"

# Springs relaxed on the way: there it comes to rest, if something damps.
echo '{ "e_gpa": 700000 }' > rigid.json
"$program" stress a.db 1112 --from 25 --rest-deg 30 --stiffness 5000 --material rigid.json --damping 150 \
  --time-step 8e-3 --time-limit 0.1 --output run > out || fail "stress with a stop"
holds "comes to rest" "j ->> 'outcome' = 'time_limit' AND j ->> 'rest_deg' = 30 AND j ->> 'damping_per_s' = 150 AND
  abs((j ->> '\$.motion.pilot_deg[#-1]') - 30) < 0.1 AND j ->> '\$.motion.kinetic_n_mm[#-1]' < 1e-3"
grep -q "^springs are relaxed at 30 deg: after 0.1000 s the pilot is at 30.0" out || fail "the text of a stop: $(cat out)"
finish
