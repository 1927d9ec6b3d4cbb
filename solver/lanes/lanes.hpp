// One batch for each instruction set, each compiled with its own flags in a file of its own. Those
// files instantiate nothing but templates on their registers: what they share with the rest of the
// program is compiled elsewhere (destructors too), or the linker might keep the copy that this
// machine cannot run: tests/system/instruction_sets.sh looks.
#pragma once

#include <memory>

namespace misalign::solver {

class Batch;
class Model;

/// The batch of an overconstrained model, whatever the instruction set: in closed form.
std::unique_ptr<Batch> make_base_batch(const Model& model);
std::unique_ptr<Batch> make_baseline_batch(const Model& model);
#ifdef MISALIGN_X86
std::unique_ptr<Batch> make_avx2_batch(const Model& model);
std::unique_ptr<Batch> make_avx512_batch(const Model& model);
#endif

}  // namespace misalign::solver
