// This file is compiled with -mavx2.
#include <xsimd/xsimd.hpp>

#include "solver/lanes/lane_batch.hpp"
#include "solver/lanes/lanes.hpp"

namespace misalign::solver {

std::unique_ptr<Batch> make_avx2_batch(const Model& model) {
  return std::make_unique<
      LaneBatch<xsimd::batch<double, xsimd::avx2>, xsimd::batch<float, xsimd::avx2>>>(model);
}

}  // namespace misalign::solver
