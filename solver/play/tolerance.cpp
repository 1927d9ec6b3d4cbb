#include "solver/play/tolerance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace misalign::solver {

void MiscutCopies::add(const Verdict& verdict) {
  ++trials;
  if (verdict.first_fault == Fault::undecided) {
    ++undecided;
    return;
  }
  const auto sample = static_cast<std::size_t>(verdict.deploys_from_sample);
  assert(verdict.deploys_from_sample >= 0);
  of_sample.resize(std::max(of_sample.size(), sample + 1));
  ++of_sample[sample];
}

void MiscutCopies::add(const MiscutCopies& others) {
  assert(others.undecided <= others.trials);
  trials += others.trials;
  undecided += others.undecided;
  stops.add(others.stops);
  of_sample.resize(std::max(of_sample.size(), others.of_sample.size()));
  for (std::size_t k = 0; k < others.of_sample.size(); ++k) of_sample[k] += others.of_sample[k];
}

std::uint64_t MiscutCopies::from(int sample) const {
  assert(sample >= 0);
  const auto first = std::min(static_cast<std::size_t>(sample), of_sample.size());
  return std::accumulate(of_sample.begin() + static_cast<std::ptrdiff_t>(first), of_sample.end(),
                         std::uint64_t{0});
}

int MiscutCopies::quantile(double share) const {
  assert(share >= 0 && share <= 1);
  const double wanted = std::max(std::ceil(share * static_cast<double>(decided())), 1.0);
  std::uint64_t counted = 0;
  for (std::size_t sample = 0; sample < of_sample.size(); ++sample) {
    counted += of_sample[sample];
    if (static_cast<double>(counted) >= wanted) return static_cast<int>(sample);
  }
  return 0;
}

double MiscutCopies::mean_sample() const {
  if (decided() == 0) return 0;
  double sum = 0;
  for (std::size_t sample = 0; sample < of_sample.size(); ++sample) {
    sum += static_cast<double>(sample) * static_cast<double>(of_sample[sample]);
  }
  return sum / static_cast<double>(decided());
}

double largest_miscut_mm(const CreasePattern& base, const Eigen::Matrix2Xd& shifts_mm) {
  CreasePattern sheet = base;
  assert(shifts_mm.cols() == base.vertex_count());
  sheet.vertices_mm += shifts_mm;
  return largest_safe_amplitude_mm(sheet, all_vertices(sheet));
}

}  // namespace misalign::solver
