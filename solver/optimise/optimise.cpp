#include "solver/optimise/optimise.hpp"

#include "solver/optimise/ascent.hpp"

namespace misalign::solver {

Studied<Optimised> optimise(const Sheet& start, const OptimiseOptions& options) {
  Studied<AscentStart> fitted = fitted_start(start, options);
  if (fitted.fault) return *fitted.fault;
  if (!fitted.study) return {};
  Ascent ascent(start, *std::move(fitted.study));
  while (!ascent.finished()) ascent.advance();
  return ascent.take();
}

}  // namespace misalign::solver
