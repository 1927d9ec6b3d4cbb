// The card of a sheet: the requirements of its design, and their results.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// Key of the requirement that a stop, latch or frame meets in place of the sheet.
inline constexpr char kUnstableAtFlat[] = "unstable_modes_at_flat";

/// A requirement, or a fact without one.
struct CardLine {
  std::string_view key;  ///< its name in JSON
  std::string what, unit;
  std::optional<double> wanted, found;
  enum class Bound { at_least, at_most } bound = Bound::at_least;
  std::string note;  ///< reason of a missing result, or a remark

  bool is_asked() const { return wanted.has_value(); }
  /// Returns whether it is met; false without a result.
  bool passes() const;
  /// The ratio of actual to required value, less one; none where either is not positive.
  std::optional<double> margin() const;
  /// "+20 %", or "30 times" of large ratios.
  std::string margin_text() const;
  /// "≥ 140°" and "156°"; empty where there is no such number.
  std::string wanted_text() const;
  std::string found_text() const;
};

/// Returns the line of that key; null if there is none.
const CardLine* line_of(const std::vector<CardLine>& lines, std::string_view key);

/// A single change that meets a requirement and breaks no other, checked by a card of its own.
struct Remedy {
  std::string key;   ///< the requirement's
  std::string what;  ///< "panels of 2.2 mm"
  /// The command that makes the changed sheet, or keys of its "design": "thickness_mm": 2.2.
  std::string typed;
  struct Price {
    std::string what, before, after;
  };
  std::vector<Price> prices;  ///< values that get worse
  bool meets_all = false;     ///< true: no requirement is left that fails
  Json pattern;               ///< the pattern file with the change
  /// "; Panel mass: 1 kg, then 1.1 kg; then all requirements are met", or less of it.
  std::string effects() const;
};

struct Card {
  std::string name;  ///< the sheet's
  double from_deg;   ///< the angle of use
  Design design;
  std::vector<CardLine> lines;
  /// Remedies of its requirements in turn, the smallest change first; none: not sought.
  std::optional<std::vector<Remedy>> remedies;

  int asked() const;
  int passed() const;
  bool passes() const { return passed() == asked(); }
  /// Returns whether a stop, latch or frame at flat is all that it lacks.
  bool passes_if_held() const;
  std::string verdict() const;  ///< a sentence without its full stop
  /// The remedies of a requirement.
  std::vector<Remedy> remedies_of(std::string_view key) const;
};

/// Returns at most two values of a changed sheet that are worse than before, the worst first:
/// margins, apart from that of `mended`, and the mass.
std::vector<Remedy::Price> prices_of(const Card& before, const Card& after,
                                     std::string_view mended);

Json card_json(const Card& card);

}  // namespace misalign::schema
