// Scores a card, so that designs can be compared.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/exchange/card_json.hpp"

namespace misalign::search {

/// The reserve of a requirement is how many times over it is met, less 1: of margins over friction
/// the ratio of the frictions that are overcome, of a yield that of the copies that may fail. More
/// than kMostReserve makes no design better, as requirements have margins of their own. Angles that
/// are reached have no reserve.
inline constexpr double kMostReserve = 0.25;

struct CardScore {
  /// The least reserve where all requirements are met; otherwise less than 0 by at least kFailure
  /// and at most 1 for each that is not.
  double value = kMostReserve;
  /// The requirement that decides: the one farthest from being met, or with the least reserve;
  /// empty: none has a reserve below kMostReserve.
  std::string key, what;

  bool passes() const { return value >= 0; }
};
inline constexpr double kFailure = 0.1;

CardScore score_of(const std::vector<schema::CardLine>& lines);

/// Returns a label without its conditions: "Static margin over hinge friction".
std::string short_label(const std::string& what);

}  // namespace misalign::search
