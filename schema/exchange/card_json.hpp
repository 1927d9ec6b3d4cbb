// A card of one sheet: what its design asks of it, and what was found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// A requirement, or where nothing is asked a fact.
struct CardLine {
  const char* key;  ///< in JSON
  std::string what, unit;
  std::optional<double> wanted, found;
  enum class Bound { at_least, at_most } bound = Bound::at_least;
  std::string note;  ///< why nothing was found, or what to know of it

  bool is_asked() const { return wanted.has_value(); }
  /// Where nothing was found it does not pass.
  bool passes() const;
  /// How much more there is than is asked, as a share of it; none where that is nothing.
  std::optional<double> margin() const;
  /// "≥ 140 deg" and "156 deg"; empty where there is no such number.
  std::string wanted_text() const;
  std::string found_text() const;
};

struct Card {
  std::string name;  ///< of the sheet
  double from_deg;   ///< the angle of use
  Design design;
  std::vector<CardLine> lines;

  int asked() const;
  int passed() const;
  bool passes() const { return passed() == asked(); }
  std::string verdict() const;  ///< in words
};

Json card_json(const Card& card);

}  // namespace misalign::schema
