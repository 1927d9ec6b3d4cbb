#include "solver/model/miscut_margin.hpp"

#include <algorithm>
#include <cmath>

#include "solver/model/pivoted_state.hpp"

namespace misalign::solver {

std::vector<int> margin_samples(double sample_deg, int threshold_sample) {
  const int every = std::max(1, static_cast<int>(std::lround(kMarginSection_deg / sample_deg)));
  const int last = std::min(threshold_sample,
                            static_cast<int>(std::floor(kPoorFactorsFrom_deg / sample_deg + 1e-9)));
  std::vector<int> samples;
  for (int k = every; k < last; k += every) samples.push_back(k);
  samples.push_back(std::max(last, 1));
  return samples;
}

}  // namespace misalign::solver
