# A function that any other file might call is compiled for every machine: what the files of the wider
# instruction sets define for the linker works on their own registers, or makes the batch. Otherwise the
# linker could keep the copy of an inline function that the machine at hand cannot run. Data (vtables,
# typeinfo) has no instructions. Only where functions are inlined: called with the object files of a
# release build.
set -u
failures=0
for set in avx2 avx512; do
  object=
  for file in "$@"; do
    case $file in *lanes_"$set".cpp.*) object=$file ;; esac
  done
  [ -n "$object" ] || { echo "FAILED: no object file of $set"; exit 1; }
  functions=$(nm --demangle --defined-only "$object" | grep ' [TWi] ')
  echo "$set: $(echo "$functions" | grep -c "xsimd::$set") functions on its registers"
  echo "$functions" | grep -q "make_${set}_batch(" || { echo "FAILED: $set makes no batch"; failures=1; }
  foreign=$(echo "$functions" | grep -v "xsimd::$set\|make_${set}_batch(")
  [ -z "$foreign" ] || { echo "FAILED: $set defines for every machine:"; echo "$foreign"; failures=1; }
done
exit $failures
