#include "solver/verdict/miscut_margin.hpp"

#include <algorithm>
#include <cmath>

#include "solver/verdict/dense_state.hpp"

namespace misalign::solver {

std::vector<int> margin_samples(double sample_deg, int threshold_sample) {
  const int every = std::max(1, static_cast<int>(std::lround(kMarginStretch_deg / sample_deg)));
  const int last = std::min(threshold_sample,
                            static_cast<int>(std::floor(kPoorFactorsFrom_deg / sample_deg + 1e-9)));
  std::vector<int> samples;
  for (int k = every; k < last; k += every) samples.push_back(k);
  samples.push_back(std::max(last, 1));
  return samples;
}

std::optional<double> miscut_margin_mm(const Mechanism& mechanism, const Elimination& elimination,
                                       const FlatVertices& vertices_mm,
                                       const std::vector<FoldState<double>>& states) {
  SheetGeometry<double> geometry;
  place(mechanism, vertices_mm, geometry);
  MiscutMargin<double> margin(mechanism, elimination);
  margin.begin(geometry);
  for (const FoldState<double>& state : states) margin.see(state);
  return margin.mm(0);
}

}  // namespace misalign::solver
