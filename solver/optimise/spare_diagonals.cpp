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
  SpareDiagonals found{{}, VectorXd::Map(angles_deg.data(), std::ssize(angles_deg)), 0};
  Eigen::MatrixXd moments(found.pilot_deg.size(), way.flat_mm().size());
  VectorXd lengths_mm, rates_mm;
  for (Index row = 0; row < moments.rows(); ++row) {
    const double x = way.x_of(found.pilot_deg(row));
    way.find_lengths(x, lengths_mm, rates_mm);
    moments.row(row) = rigid.spring_forces_n(x).cwiseProduct(rates_mm) / way.pilot_rate(x);
  }
  if (moments.rowwise().sum().minCoeff() <= 0) return {};
  found.few = few_diagonals(moments, kShareOfFew);
  const auto spare = static_cast<double>(moments.cols() - std::ssize(found.few.diagonals));
  found.amount = spare + std::clamp(found.few.share_of_fewer / kShareOfFew, 0.0, 1.0);
  assert(found.amount >= 0 && found.amount <= static_cast<double>(moments.cols()));
  return found;
}

}  // namespace misalign::solver
