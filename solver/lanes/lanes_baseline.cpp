// This file is compiled for the instruction set that every machine of the architecture has.
#include <xsimd/xsimd.hpp>

#include "solver/lanes/lane_batch.hpp"
#include "solver/lanes/lanes.hpp"

namespace misalign::solver {

std::unique_ptr<Batch> make_baseline_batch(const Model& model) {
  return std::make_unique<LaneBatch<xsimd::batch<double, xsimd::default_arch>,
                                    xsimd::batch<float, xsimd::default_arch>>>(model);
}

}  // namespace misalign::solver
