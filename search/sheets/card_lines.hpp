// Lines of a card as studies add them, and the sheet that they are about.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "schema/exchange/card_json.hpp"
#include "search/sheets/chosen_sheet.hpp"

namespace misalign::search {

/// A sheet of a design, which may differ from that of its model, and its angle of use in degrees.
struct CardSheet {
  const ChosenSheet& chosen;
  const solver::Sheet& sheet;
  const schema::Design& design;
  double used_deg;

  /// The angle at which the filling is relaxed: 0 for flat.
  double stop_deg() const { return design.rest_deg.value_or(0); }
};

class CardLines {
 public:
  using Bound = schema::CardLine::Bound;
  using Number = std::optional<double>;

  /// Adds a requirement, or a fact where `wanted` is none.
  void ask(const char* key, const std::string& what, const char* unit, Number wanted, Number found,
           Bound bound = Bound::at_least, const std::string& note = "") {
    lines_.push_back({key, what, unit, wanted, found, bound, note});
  }
  void tell(const char* key, const std::string& what, const char* unit, Number found,
            const std::string& note = "") {
    ask(key, what, unit, {}, found, Bound::at_least, note);
  }
  /// Adds the margin of the friction that is overcome over the design's, where that is not 0.
  void margin(const char* key, const std::string& what, double wanted, Number overcome,
              double friction) {
    if (friction > 0) {
      ask(key, what, "", wanted, overcome ? *overcome / friction - 1 : -1);
    } else {
      tell(key, what, "", {}, "the design names no friction");
    }
  }

  schema::CardLine& last() { return lines_.back(); }
  std::vector<schema::CardLine> take() { return std::move(lines_); }

 private:
  std::vector<schema::CardLine> lines_;
};

}  // namespace misalign::search
