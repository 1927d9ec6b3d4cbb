// This file is compiled with -mavx512f.
#include <xsimd/xsimd.hpp>

#include "solver/lanes/lane_batch.hpp"
#include "solver/lanes/lanes.hpp"

namespace misalign::solver {

std::unique_ptr<Batch> make_avx512_batch(const Model& model) {
  return std::make_unique<
      LaneBatch<xsimd::batch<double, xsimd::avx512f>, xsimd::batch<float, xsimd::avx512f>>>(model);
}

}  // namespace misalign::solver
