#include "solver/fill/certifiable.hpp"

#include <algorithm>

namespace misalign::solver {
namespace {

const char* why_no_wells(const Springs& springs) {
  if (springs.pull_only)
    return "the force of springs that only pull has a corner where they slacken";
  const auto is_rigid = [](const SingleSpring& spring) { return spring.stiffness_n_per_mm > 0; };
  if (springs.stiffness_n_per_mm <= 0 && std::ranges::none_of(springs.single, is_rigid)) {
    return "springs without stiffness have no energy";
  }
  return nullptr;
}

const char* why_not(const Springs& springs) {
  if (springs.rest_deg != 0 || !springs.other_rests_deg.empty()) {
    return "springs that are not relaxed flat have more energy there than farther on";
  }
  if (springs.on != SpringsOn::all) {
    return "which diagonals have springs depends on how the sheet starts to fold";
  }
  return why_no_wells(springs);
}

const char* why_not(const RubberPlates& plates, const SpringEnds& ends) {
  if (plates.rest_deg != 0) {
    return "plates that are not relaxed flat have more energy there than farther on";
  }
  if (plates.prestretch <= 1 && plates.cut_outs.empty()) {
    return "plates without pre-stretch wrinkle from flat on, and proofs are of tense ones";
  }
  if (!ends.at_vertices()) return "plates are bonded to whole edges of holes";
  return nullptr;
}

}  // namespace

const char* why_not_certifiable(const Fill& fill, const SpringEnds& ends) {
  if (const auto* springs = std::get_if<Springs>(&fill)) return why_not(*springs);
  if (const auto* plates = std::get_if<RubberPlates>(&fill)) return why_not(*plates, ends);
  return "nothing fills the holes";
}

const char* why_no_wells(const Fill& fill, const SpringEnds& ends) {
  if (const auto* springs = std::get_if<Springs>(&fill)) return why_no_wells(*springs);
  if (rest_deg(fill) != 0) return "proofs know plates that are relaxed flat alone";
  return why_not_certifiable(fill, ends);
}

}  // namespace misalign::solver
