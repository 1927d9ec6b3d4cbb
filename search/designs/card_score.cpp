#include "search/designs/card_score.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace misalign::search {
namespace {

using schema::CardLine;

// The least share of failing copies that 1,000 of them tell from none.
constexpr double kLeastFailing = 1e-3;

// Reserve of a requirement; none where it has no ratio.
std::optional<double> reserve_of(const CardLine& line) {
  const std::string_view key = line.key;
  if (key.find("margin") != std::string_view::npos)
    return (1 + *line.found) / (1 + *line.wanted) - 1;
  if (key == "yield" && line.passes()) {
    return (1 - *line.wanted) / std::max(kLeastFailing, 1 - *line.found) - 1;
  }
  if (line.unit == "deg" && line.passes()) return {};
  return line.margin();
}

double shortfall_of(const CardLine& line) {
  double share = 1;
  if (line.found && std::isfinite(*line.found)) {
    const std::optional<double> reserve = reserve_of(line);
    const double distance = std::abs(*line.found - *line.wanted);
    share = reserve ? -*reserve : distance / (1 + distance);
  }
  return kFailure + (1 - kFailure) * std::clamp(share, 0.0, 1.0);
}

}  // namespace

CardScore score_of(const std::vector<CardLine>& lines) {
  CardScore met, failing;
  failing.value = 0;
  double most = 0;
  for (const CardLine& line : lines) {
    if (!line.is_asked()) continue;
    // Rounding of hopeless designs may leave no number.
    if (!line.passes() || std::isnan(*line.found)) {
      const double shortfall = shortfall_of(line);
      failing.value -= shortfall;
      if (shortfall > most) {
        most = shortfall;
        failing.key = line.key;
        failing.what = line.what;
      }
    } else if (const auto reserve = reserve_of(line); reserve && *reserve < met.value) {
      met = {std::max(0.0, *reserve), std::string(line.key), line.what};
    }
  }
  return failing.value < 0 ? failing : met;
}

std::string short_label(const std::string& what) { return what.substr(0, what.find(',')); }

}  // namespace misalign::search
