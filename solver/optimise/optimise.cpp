#include "solver/optimise/optimise.hpp"

#include "solver/optimise/ascent.hpp"
#include "solver/optimise/fitted_start.hpp"

namespace misalign::solver {

StudyResult<Optimised> optimise(const Sheet& start, const OptimiseOptions& options) {
  StudyResult<Optimised> fitted = fitted_start(start, options);
  if (!fitted) return fitted.obstacle();
  Ascent ascent(start, *std::move(fitted));
  while (!ascent.finished()) ascent.advance();
  return ascent.release();
}

}  // namespace misalign::solver
