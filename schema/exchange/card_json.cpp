#include "schema/exchange/card_json.hpp"

#include "schema/files/json_values.hpp"

namespace misalign::schema {

Json card_json(const Card& card) {
  Json lines = Json::array();
  for (const CardLine& line : card.lines) {
    Json one = {{"key", line.key},
                {"what", line.what},
                {"unit", line.unit},
                {"wanted", or_null(line.wanted)},
                {"found", or_null(line.found)},
                {"bound", line.bound == CardLine::Bound::at_least ? "at_least" : "at_most"},
                {"margin", or_null(line.margin())},
                {"passes", line.is_asked() ? Json(line.passes()) : Json()}};
    if (!line.note.empty()) one["note"] = line.note;
    lines.push_back(std::move(one));
  }
  return {{"passes", card.passes()},
          {"asked", card.asked()},
          {"passed", card.passed()},
          {"from_deg", card.from_deg},
          {"design", said_design_json(card.design)},
          {"lines", lines}};
}

}  // namespace misalign::schema
