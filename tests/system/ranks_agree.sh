# Any number of ranks, any unit size, any order: the same digest.
. "$(dirname "$0")/lib.sh"
campaign=$source_dir/search/campaigns/miura-4x4.json
draws=1500

"$program" search "$campaign" --catalogue alone.db --draws $draws --progress none || fail "alone"
sound alone.db $draws
expected=$(digest_of alone.db)
[ ${#expected} = 32 ] || fail "no digest: '$expected'"
[ "$(sql alone.db 'SELECT count(*) FROM candidate')" -gt 500 ] || fail "too few candidates to compare"

for n in 1 2 3; do
  for unit in 1 37 100000; do
    [ "$unit" = 1 ] && [ "$n" != 3 ] && continue
    file=ranks-$n-$unit.db
    "${ranks[@]}" $n "$program" search "$campaign" --catalogue $file --draws $draws --unit-draws $unit --progress none \
      > out 2> err || { fail "$n ranks, units of $unit"; cat err; }
    sound $file $draws
    [ "$(digest_of $file)" = "$expected" ] || fail "$n ranks, units of $unit: another digest"
  done
done
[ "$(sql ranks-3-37.db 'SELECT count(DISTINCT worker) FROM unit')" = 3 ] || fail "an idle rank"

# Results that take more than a message may are several units, without which a unit of 2 GB would be
# sent as one of a negative length.
for n in 1 3; do
  "${ranks[@]}" $n "$program" search "$campaign" --catalogue bytes-$n.db --draws $draws --unit-draws 100000 \
    --unit-bytes 30000 --progress none > out 2> err || { fail "$n ranks, small messages"; cat err; }
  grep -q "bytes-$n.db: complete" out || fail "$n ranks, small messages: $(cat out)"
  sound bytes-$n.db $draws
  [ "$(digest_of bytes-$n.db)" = "$expected" ] || fail "$n ranks, small messages: another digest"
  [ "$(sql bytes-$n.db 'SELECT count(*) FROM unit')" -ge 10 ] || fail "$n ranks: messages were not small"
done

# The registers of every instruction set give the same, and so does a C library that must do without.
for set in baseline avx2 avx512; do
  "$program" search "$campaign" --catalogue set-$set.db --draws $draws --progress none --instruction-set $set \
    > out 2> err
  code=$?
  [ $code = 2 ] && [ $set != baseline ] && grep -q "instruction-set" err && continue  # not this machine's
  [ $code = 0 ] || fail "$set: exit $code"
  [ "$(digest_of set-$set.db)" = "$expected" ] || fail "$set: another digest"
done
GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2,-FMA,-FMA4 "$program" search "$campaign" \
  --catalogue plain.db --draws $draws --progress none > /dev/null 2>&1 || fail "without FMA and AVX2"
[ "$(digest_of plain.db)" = "$expected" ] || fail "without FMA and AVX2 in the C library: another digest"

# Candidates agree in every column that a verdict or a person reads.
rows="SELECT draw, deploys_from_sample, displacements_mm, elongation FROM candidate ORDER BY draw"
[ "$(sql alone.db "$rows" | cksum)" = "$(sql ranks-3-37.db "$rows" | cksum)" ] || fail "rows differ"

# A total, not "more": nothing is done twice, and a larger total goes on from there.
"$program" search "$campaign" --catalogue alone.db --draws $draws --progress none > /dev/null 2>&1
[ "$(sql alone.db 'SELECT sum(draws) FROM unit')" = $draws ] || fail "--draws is not a total"
"$program" search "$campaign" --catalogue steps.db --draws 500 --progress none > /dev/null 2>&1
"$program" search "$campaign" --catalogue steps.db --draws $draws --progress none > /dev/null 2>&1
[ "$(digest_of steps.db)" = "$expected" ] || fail "two steps: another digest"

# Ranges in the wrong order fill up to the same.
"$program" search "$campaign" --catalogue ranges.db --range 1000:1500 --progress none > /dev/null 2>&1
"$program" search "$campaign" --catalogue ranges.db --range 300:600 --progress none > /dev/null 2>&1
"$program" search "$campaign" --catalogue ranges.db --draws $draws --progress none > /dev/null 2>&1
sound ranges.db $draws
[ "$(digest_of ranges.db)" = "$expected" ] || fail "ranges: another digest"

quick_campaign quick.json
# With a goal of accepted draws the end is a multiple of 4096, whoever works.
for n in 1 3; do
  "${ranks[@]}" $n "$program" search quick.json --catalogue accepted-$n.db --accepted 1000 --unit-draws 50 \
    --progress none > /dev/null 2>&1 || fail "--accepted with $n ranks"
  [ "$(sql accepted-$n.db 'SELECT goal_end FROM campaign')" = 4096 ] || fail "goal_end of accepted-$n"
done
[ "$(digest_of accepted-1.db)" = "$(digest_of accepted-3.db)" ] || fail "--accepted: another digest"
finish
