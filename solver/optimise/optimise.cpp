#include "solver/optimise/optimise.hpp"

#include "solver/optimise/ascent.hpp"

namespace misalign::solver {

StudyResult<Optimised> optimise(const Sheet& start, const OptimiseOptions& options) {
  StudyResult<AscentStart> fitted = fitted_start(start, options);
  if (!fitted) return fitted.obstacle();
  Ascent ascent(start, *std::move(fitted));
  while (!ascent.finished()) ascent.advance();
  return ascent.take();
}

}  // namespace misalign::solver
