#include "search/sheets/card_limits.hpp"

#include <algorithm>

#include "search/sheets/card_changes.hpp"
#include "search/sheets/deploy_input.hpp"

namespace misalign::search {

void keep_card(const Subject& subject, const CardOptions& copies, schema::OptimiseBounds& bounds) {
  const schema::Card card = card_of(subject, copies).card;
  const double friction = hinge_friction_n_mm_per_mm(subject.model.design(), subject.sheet);
  std::vector<solver::OptimiseFloor>& floors = bounds.floors;
  for (const solver::OptimiseFloor& floor : kept_floors(card, friction)) {
    const bool is_given =
        std::ranges::find(floors, floor.goal, &solver::OptimiseFloor::goal) != floors.end();
    if (!is_given) floors.push_back(floor);
  }
}

}  // namespace misalign::search
