#include "solver/optimise/spare_diagonals.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/motion/actuation.hpp"

namespace misalign::solver {

using Eigen::Index;
using Eigen::VectorXd;

std::optional<SpareDiagonals> spare_diagonals(const Sheet& sheet, const EnergyModel& rigid,
                                              double from_deg) {
  const FoldingWay& way = *sheet.way();
  const double sample_deg = sheet.model().sample_deg();
  assert(sample_deg > 0 && from_deg > 0);
  std::vector<double> angles_deg;
  for (double k = std::ceil(kSlopeFrom_deg / sample_deg); k * sample_deg < from_deg; ++k) {
    angles_deg.push_back(k * sample_deg);
  }
  angles_deg.push_back(from_deg);
  SpareDiagonals result{{}, VectorXd::Map(angles_deg.data(), std::ssize(angles_deg)), 0};
  Eigen::MatrixXd moments(result.pilot_deg.size(), way.flat_mm().size());
  VectorXd lengths_mm, rates_mm;
  for (Index row = 0; row < moments.rows(); ++row) {
    const double x = way.x_of(result.pilot_deg(row));
    way.find_lengths(x, lengths_mm, rates_mm);
    moments.row(row) = rigid.filling_forces_n(x).cwiseProduct(rates_mm) / way.pilot_rate(x);
  }
  if (moments.rowwise().sum().minCoeff() <= 0) return {};
  result.few = *few_diagonals(moments, kShareOfFew);
  const auto spare = static_cast<double>(moments.cols() - std::ssize(result.few.diagonals));
  result.amount = spare + std::clamp(result.few.share_of_fewer / kShareOfFew, 0.0, 1.0);
  return result;
}

}  // namespace misalign::solver
