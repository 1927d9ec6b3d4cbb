#include "schema/pattern/design_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/pattern/preload_json.hpp"
#include "solver/kinematics/mechanism.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::schema {

void check_names(const Design& design, const solver::PerforatedSheet& base,
                 const std::string& source) {
  InputFaults faults;
  if (!design.other_preloads.empty()) {
    find_preload_faults(design.other_preloads, solver::build_mechanism(base), faults);
  }
  const auto is_held = [&](int facet) {
    const auto& place = base.sheet.places[static_cast<std::size_t>(facet)];
    return place[0] == design.hold->at(0) && place[1] == design.hold->at(1);
  };
  if (design.hold && std::ranges::none_of(solver::kept_facets(base.sheet, base.holes), is_held)) {
    faults.add(fmt::format("hold = [{}, {}]", design.hold->at(0), design.hold->at(1)),
               "is no panel of this sheet; rows and columns count from 0, and holes cannot be held",
               "name one such as [0, 0], or write null");
  }
  faults.refuse(source + ": design");
}

}  // namespace misalign::schema
