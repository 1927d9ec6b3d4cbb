# A function that any other file might call is compiled for every machine: what the files of the wider
# instruction sets define for the linker works on their own registers, or is what they are called for. Otherwise the
# linker could keep the copy of an inline function that the machine at hand cannot run. Data (vtables,
# typeinfo) has no instructions. Only where functions are inlined: called with the object files of a
# release build.
set -u
failures=0
# Of each file, by name: its set, what it is called for, and what is its own beside that.
for row in 'lanes_avx2 make_avx2_batch xsimd::avx2' 'lanes_avx512 make_avx512_batch xsimd::avx512' \
  'product_sums_ssse3 add_products_ssse3' \
  'product_sums_avx2 add_products_avx2' 'product_sums_vnni add_products_vnni' 'philox_avx2 philox_avx2'; do
  read -r name makes own <<< "$row"
  object=
  for file in "$@"; do
    case $file in */"$name".cpp.*) object=$file ;; esac
  done
  [ -n "$object" ] || { echo "FAILED: no object file of $name"; exit 1; }
  functions=$(nm --demangle --defined-only "$object" | grep ' [TWi] ')
  echo "$name: $(echo "$functions" | wc -l) functions"
  echo "$functions" | grep -q "::$makes(" || { echo "FAILED: $name has no $makes"; failures=1; }
  foreign=$(echo "$functions" | grep -v "::$makes(${own:+\\|$own}")
  [ -z "$foreign" ] || { echo "FAILED: $name defines for every machine:"; echo "$foreign"; failures=1; }
done
exit $failures
