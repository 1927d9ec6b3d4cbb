// The card of a sheet: the requirements of its design, and their results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// A requirement, or a fact without one.
struct CardLine {
  const char* key;  ///< its name in JSON
  std::string what, unit;
  std::optional<double> wanted, found;
  enum class Bound { at_least, at_most } bound = Bound::at_least;
  std::string note;  ///< reason of a missing result, or a remark

  bool is_asked() const { return wanted.has_value(); }
  /// Returns whether it is met; false without a result.
  bool passes() const;
  /// The ratio of actual to required value, less one; none where either is not positive.
  std::optional<double> margin() const;
  /// "≥ 140°" and "156°"; empty where there is no such number.
  std::string wanted_text() const;
  std::string found_text() const;
};

struct Card {
  std::string name;  ///< the sheet's
  double from_deg;   ///< the angle of use
  Design design;
  std::vector<CardLine> lines;

  int asked() const;
  int passed() const;
  bool passes() const { return passed() == asked(); }
  std::string verdict() const;  ///< a sentence without its full stop
};

Json card_json(const Card& card);

}  // namespace misalign::schema
