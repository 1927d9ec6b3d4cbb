#include "schema/pattern/design_fill.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::schema {
namespace {

solver::RubberPlates plates_of(const DesignFill& design, const solver::PerforatedSheet& base) {
  solver::RubberPlates plates;
  plates.shear_mpa = design.shear_mpa.value_or(plates.shear_mpa);
  plates.thickness_mm = design.plate_mm.value_or(plates.thickness_mm);
  plates.prestretch = design.prestretch.value_or(plates.prestretch);
  plates.rest_deg = design.rest_deg.value_or(plates.rest_deg);
  for (const auto& [hole, of_flat] : design.cut_outs) {
    plates.cut_outs.push_back({hole_at(base, hole), of_flat});
  }
  return plates;
}

}  // namespace

int hole_at(const solver::PerforatedSheet& base, const std::array<int, 2>& place) {
  const auto is_it = [&](int facet) {
    return base.sheet.places[static_cast<std::size_t>(facet)] == place;
  };
  const auto at = std::ranges::find_if(base.holes, is_it);
  return at == base.holes.end() ? -1 : static_cast<int>(at - base.holes.begin());
}

solver::Springs DesignFill::springs() const {
  assert(is_springs());
  solver::Springs springs;
  springs.stiffness_n_per_mm = stiffness_n_per_mm.value_or(springs.stiffness_n_per_mm);
  springs.rest_deg = rest_deg.value_or(springs.rest_deg);
  springs.pull_only = pull_only.value_or(springs.pull_only);
  springs.on = springs_on.value_or(springs.on);
  springs.preload = {preload_n.value_or(0), other_preloads};
  springs.single = single_springs;
  return springs;
}

solver::Fill DesignFill::fill(const solver::PerforatedSheet& base) const {
  if (fill_kind == FillKind::none) return solver::NoFill{};
  if (is_plate()) return plates_of(*this, base);
  return springs();
}

DesignFill design_of(const solver::Fill& fill, const solver::PerforatedSheet& base) {
  DesignFill design;
  design.fill_kind = FillKind::none;
  if (const auto* const springs = std::get_if<solver::Springs>(&fill)) {
    design.fill_kind = FillKind::springs;
    design.rest_deg = springs->rest_deg;
    design.stiffness_n_per_mm = springs->stiffness_n_per_mm;
    design.preload_n = springs->preload.each_n;
    design.other_preloads = springs->preload.others;
    design.pull_only = springs->pull_only;
    design.springs_on = springs->on;
    design.single_springs = springs->single;
  } else if (const auto* const plates = std::get_if<solver::RubberPlates>(&fill)) {
    design.fill_kind = FillKind::plate;
    design.rest_deg = plates->rest_deg;
    design.shear_mpa = plates->shear_mpa;
    design.plate_mm = plates->thickness_mm;
    design.prestretch = plates->prestretch;
    for (const auto& [hole, of_flat] : plates->cut_outs) {
      const int facet = base.holes[static_cast<std::size_t>(hole)];
      design.cut_outs.push_back({base.sheet.places[static_cast<std::size_t>(facet)], of_flat});
    }
  }
  return design;
}

}  // namespace misalign::schema
