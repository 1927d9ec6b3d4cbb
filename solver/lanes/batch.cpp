#include "solver/lanes/batch.hpp"

#include "solver/lanes/lanes.hpp"

namespace misalign::solver {

Batch::~Batch() = default;

const char* instruction_set_name(InstructionSet set) {
  switch (set) {
    case InstructionSet::baseline:
      return "baseline";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "";
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::baseline};
#ifdef MISALIGN_X86
  if (__builtin_cpu_supports("avx2")) sets.push_back(InstructionSet::avx2);
  if (__builtin_cpu_supports("avx512f")) sets.push_back(InstructionSet::avx512);
#endif
  return sets;
}

std::unique_ptr<Batch> make_batch(InstructionSet set, const Model& model) {
  if (model.is_overconstrained()) return make_base_batch(model);
  switch (set) {
#ifdef MISALIGN_X86
    case InstructionSet::avx512:
      return make_avx512_batch(model);
    case InstructionSet::avx2:
      return make_avx2_batch(model);
#endif
    default:
      return make_baseline_batch(model);
  }
}

}  // namespace misalign::solver
