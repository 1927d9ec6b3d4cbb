#include "solver/fitting/stock_drive.hpp"

#include <algorithm>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Springs overcome this share more than is required at places, so that they do between them, too.
constexpr double kBetweenPlaces = 1e-3;
// The energy falls where springs overcome at least this share of the largest that one overcomes.
constexpr double kFalls = 1e-6;
// The energy is required to fall down to this angle; below it moments are proportional to it.
constexpr double kNearlyFlat_deg = 0.05;

// Places down to nearly flat; one of them is at `to_deg`.
std::vector<DrivenPlace> places_of(const FoldingWay& way, double from_deg, double to_deg) {
  const double least_deg = std::min(kNearlyFlat_deg, to_deg / 2);
  std::vector<DrivenPlace> places = SpringProgram(way, to_deg, least_deg).places();
  places.pop_back();
  const std::vector<DrivenPlace> above = SpringProgram(way, from_deg, to_deg).places();
  places.insert(places.end(), above.begin(), above.end());
  return places;
}

}  // namespace

StockDrive::StockDrive(const FoldingWay& way, double from_deg,
                       const std::vector<StockSpring>& table, const StockOptions& options)
    : table_(table), options_(options) {
  const std::vector<DrivenPlace> places = places_of(way, from_deg, options.to_deg);
  const Index count = std::ssize(places), diagonals = way.flat_mm().size();
  pilot_deg_.resize(count);
  demand_.setZero(count);
  per_n_.resize(count, diagonals);
  lengths_per_n_.resize(count, diagonals);
  least_mm_ = most_mm_ = way.flat_mm();
  for (Index p = 0; p < count; ++p) {
    const DrivenPlace& place = places[static_cast<std::size_t>(p)];
    pilot_deg_(p) = place.pilot_deg;
    per_n_.row(p) = place.slope_mm / place.turning_mm;
    lengths_per_n_.row(p) = per_n_.row(p).transpose().cwiseProduct(place.length_mm);
    least_mm_ = least_mm_.cwiseMin(place.length_mm);
    most_mm_ = most_mm_.cwiseMax(place.length_mm);
    if (!counts(p)) continue;
    demand_(p) = options.required_n_mm_per_mm * (1 + kBetweenPlaces);
  }
  VectorXd largest = VectorXd::Zero(count);
  for (int d = 0; d < diagonals; ++d) {
    for (int t = 0; t < types(); ++t) {
      for (const StockPick& pick : picks(d, t)) largest = largest.cwiseMax(gains(pick));
    }
  }
  demand_ = demand_.cwiseMax(kFalls * largest);
}

VectorXd StockDrive::gains(const StockPick& pick) const {
  const StockSpring& spring = table_[static_cast<std::size_t>(pick.type)];
  const double free_mm = spring.linear_free_mm() + pick.link * options_.links.step_mm;
  return spring.rate_n_per_mm *
         (lengths_per_n_.col(pick.diagonal) - free_mm * per_n_.col(pick.diagonal));
}

VectorXd StockDrive::gains(const std::vector<StockPick>& picks) const {
  VectorXd sum = VectorXd::Zero(places());
  for (const StockPick& pick : picks) sum += gains(pick);
  return sum;
}

LinkRange StockDrive::links(int diagonal, int type) const {
  const StockSpring& spring = table_[static_cast<std::size_t>(type)];
  const bool is_barred = std::ranges::count(options_.barred, diagonal) > 0;
  if (is_barred || (spring.action == SpringAction::pushes && !options_.pushes)) return {0, -1};
  LinkRange range = links_of(spring, least_mm_(diagonal), most_mm_(diagonal), options_.links);
  // A filling has positive free lengths.
  while (!range.is_empty() && spring.linear_free_mm() + range.least * options_.links.step_mm <= 0) {
    ++range.least;
  }
  return range;
}

// The shortest link pulls most on a diagonal that lengthens. Springs that pull are of no use on one
// that shortens, where the longest spacer pushes most.
std::vector<StockPick> StockDrive::picks(int diagonal, int type) const {
  const LinkRange range = links(diagonal, type);
  if (range.is_empty()) return {};
  const bool is_pulling = pulls(type);
  const bool lengthens = per_n_.col(diagonal).minCoeff() >= 0;
  const bool shortens = per_n_.col(diagonal).maxCoeff() <= 0;
  if (lengthens || shortens) {
    if (is_pulling != lengthens) return {};
    return {{diagonal, type, is_pulling ? range.least : range.most}};
  }
  std::vector<StockPick> picks;
  for (int link = range.least; link <= range.most; ++link) picks.push_back({diagonal, type, link});
  return picks;
}

}  // namespace misalign::solver
