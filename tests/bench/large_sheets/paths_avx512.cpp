// Compiled with -mavx512f.
#include <xsimd/xsimd.hpp>

#include "tests/bench/large_sheets/paths.hpp"

namespace misalign::bench {

using Register = xsimd::batch<double, xsimd::avx512f>;

Followed follow_nodes_avx512(const LargeSheets& sheets, const solver::Elimination& elimination,
                             int paths) {
  solver::PathFollower<Register, solver::LongSteps> follower(sheets.mechanism, elimination);
  return follow(follower, sheets, paths);
}

Followed follow_close_avx512(const LargeSheets& sheets, const solver::Elimination& elimination,
                             int paths) {
  solver::PathFollower<Register> follower(sheets.mechanism, elimination);
  return follow(follower, sheets, paths);
}

}  // namespace misalign::bench
