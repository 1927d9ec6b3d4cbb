# Campaigns of the parallel family: one digest however they are run, all members deploy, and what is written holds.
. "$(dirname "$0")/lib.sh"
echo '{ "name": "p", "pattern": { "family": "miura", "rows": 4, "columns": 4 }, "misalignment": { "kind": "parallel",
  "vertices": "all", "amplitude_mm": 4 }, "accept": { "deploys_from_deg": 179 } }' > p.json
draws=300
"$program" search p.json --catalogue alone.db --draws $draws > out 2>&1 || fail "alone: $(cat out)"
sound alone.db $draws
[ "$(sql alone.db 'SELECT count(*) FROM candidate')" = $draws ] || fail "a member does not deploy"
expected=$(digest_of alone.db)
[ ${#expected} = 32 ] || fail "no digest: '$expected'"
for n in 2 3; do
  "${ranks[@]}" $n "$program" search p.json --catalogue $n.db --draws $draws --unit-draws 37 > out 2>&1 || fail "$n ranks"
  [ "$(digest_of $n.db)" = "$expected" ] || fail "$n ranks: another digest"
done
"$program" search p.json --catalogue low.db --range 0:170 > out 2>&1 || fail "low: $(cat out)"
"$program" search p.json --catalogue high.db --range 150:$draws > out 2>&1 || fail "high: $(cat out)"
"$program" merge both.db low.db high.db > out 2>&1 || fail "merge: $(cat out)"
[ "$(digest_of both.db)" = "$expected" ] || fail "merged: another digest"
for set in baseline avx2 avx512; do
  "$program" search p.json --catalogue set.db --draws $draws --instruction-set $set > out 2> err
  [ $? = 2 ] && [ $set != baseline ] && grep -q instruction-set err && continue  # not this machine's
  [ "$(digest_of set.db)" = "$expected" ] || fail "$set: another digest"
  rm -f set.db*
done
"$program" verify alone.db --all > out 2>&1 || fail "verify: $(cat out)"
# A candidate that is no member of the family, or another draw's.
cp alone.db spoilt.db
sqlite3 spoilt.db "UPDATE candidate SET displacements_mm = (SELECT displacements_mm FROM candidate WHERE draw = 5)
  WHERE draw = 4"
"$program" verify spoilt.db --all > out 2>&1 && fail "another draw's shifts hold"
"$program" replay alone.db 4 > replayed || fail "replay"
grep -q "^draw 4 of p: accepted" replayed || fail "replay says: $(head -1 replayed)"
"$program" export alone.db --best 1 --output made > names || fail "export"
"$program" certify "$(cat names)" --to 179.9 > proof 2>&1 || fail "certify: $(cat proof)"
grep -q "179.9" proof || fail "what is proven: $(cat proof)"
sed 's/"parallel"/"paralel"/' p.json > odd.json
"$program" config --check odd.json > out 2> err
[ $? = 3 ] && grep -q 'write "free" or "parallel"' err || fail "an unknown kind: $(cat err)"
sed "s|{ \"family\".*}, \"mis|{ \"family\": \"fold\", \"file\": \"$source_dir/search/patterns/turned-quads-6x6.fold\" }, \"mis|" \
  p.json > none.json
"$program" config --check none.json > out 2> err
[ $? = 3 ] && grep -q "no parallel family: the hole A10-A11-A18-A17 is no parallelogram" err || fail "a base without it: $(cat err)"
finish
