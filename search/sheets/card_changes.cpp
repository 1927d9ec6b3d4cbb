#include "search/sheets/card_changes.hpp"

#include <algorithm>
#include <iterator>

#include "solver/contact/spring_clearance.hpp"
#include "solver/records/strokes.hpp"

namespace misalign::search {
namespace {

using schema::Design;
using Way = NumberChange::Way;

void double_one_a_hole(Design& design) {
  design.springs_on = solver::SpringsOn::one_a_hole;
  design.stiffness_n_per_mm = 2 * design.springs().stiffness_n_per_mm;
  if (design.preload_n) *design.preload_n *= 2;
}
constexpr char kDoubledOneAHole[] =
    "design.springs.on = \"one_a_hole\", with twice the rate and preload";

const std::vector<NumberChange> kNumberChanges = {
    {.number = &Design::thickness_mm,
     .usual = solver::Plates{}.thickness_mm,
     .factor = 1.5,
     .way = Way::both,
     .what = "panels of {:g} mm",
     .mends = {"energy_margin", "static_margin", "static_friction_n_mm_per_mm",
               "largest_stress_mpa", "buckling_factor", "landing_deg_per_s"},
     .limited_by = {"thickness_mm"}},
    {.number = &Design::stiffness_n_per_mm,
     .usual = solver::Springs{}.stiffness_n_per_mm,
     .factor = 4,
     .way = Way::both,
     .what = "springs of {:g} N/mm",
     .mends = {"energy_margin", "static_margin", "static_friction_n_mm_per_mm",
               "largest_stress_mpa", "buckling_factor", "largest_force_n", "landing_deg_per_s"}},
    {.number = &Design::preload_n,
     .usual = 0.1,
     .factor = 4,
     .way = Way::both,
     .what = "a preload of {:g} N",
     .mends = {"static_margin", "static_friction_n_mm_per_mm", "largest_stress_mpa",
               "buckling_factor", "largest_force_n", "pin_locks_in_middle_deg",
               "pin_locks_at_ends_deg"},
     .also = [](Design& design) { design.hold_flat = true; },
     .also_typed = "design.hold_flat = true"},
    {.number = &Design::friction_n_mm_per_mm,
     .usual = 0,
     .factor = 2,
     .way = Way::down,
     .what = "hinges with a friction of {:g} N mm/mm",
     .mends = {},
     .margins = {"energy_margin", "static_margin"}},
    {.number = &Design::pin_friction_mm,
     .usual = 0,
     .factor = 4,
     .way = Way::down,
     .what = "pins whose radius times friction coefficient is {:g} mm",
     .mends = {"pin_locks_in_middle_deg", "pin_locks_at_ends_deg"},
     .margins = {"pin_margin_in_middle", "pin_margin_at_ends"}},
    {.number = &Design::miscut_mm,
     .usual = solver::kLeastStroke_mm,
     .factor = 1.5,
     .way = Way::down,
     .what = "cuts within ±{:g} mm",
     .mends = {"yield"},
     .limited_by = {"least_stroke_mm"}},
    {.number = &Design::play_mm,
     .usual = 0,
     .factor = 2,
     .way = Way::down,
     .what = "joint clearances of {:g} mm",
     .mends = {},
     .limited_by = {"play_mm"}},
    {.number = &Design::diameter_mm,
     .usual = solver::kSpringDiameter_mm,
     .factor = 1.5,
     .way = Way::down,
     .what = "springs {:g} mm in diameter",
     .mends = {"spring_clearance_mm"}},
    {.number = &Design::diameter_mm,
     .usual = solver::kSpringDiameter_mm,
     .factor = 1.5,
     .way = Way::down,
     .what = "one spring a hole, {:g} mm in diameter, of twice the rate and preload",
     .mends = {"spring_clearance_mm"},
     .also = double_one_a_hole,
     .also_typed = kDoubledOneAHole},
    {.number = &Design::stroke_limit,
     .usual = 0,
     .factor = 1.5,
     .way = Way::up,
     .what = "springs for an elongation of {:g}",
     .mends = {},
     .limited_by = {"stroke"}},
    {.number = &Design::largest_force_n,
     .usual = 0,
     .factor = 1.5,
     .way = Way::up,
     .what = "springs for {:g} N",
     .mends = {},
     .limited_by = {"largest_force_n"}},
    {.number = &Design::from_deg,
     .usual = 0,
     .factor = 1.1,
     .way = Way::down,
     .what = "use from {:g}°",
     .mends = {"thickness_mm", "spring_clearance_mm", "stroke", "largest_stress_mpa",
               "largest_force_n", "yield"},
     .limited_by = {"deploys_from_deg", "certified_deg", "energy_falls_from_deg",
                    "first_contact_deg"}}};

const std::vector<SwitchChange> kSwitchChanges = {
    {[](Design& design) { design.hold_flat = true; },
     "a stop, latch or frame at flat",
     "design.hold_flat = true",
     0.1,
     {"unstable_modes_at_flat"}},
    {[](Design& design) {
       design.preload_n = 0;
       design.other_preloads.clear();
     },
     "no preload",
     "design.springs.preload_n = 0",
     0.3,
     {"unstable_modes_at_flat"}},
    {[](Design& design) { design.springs_on = solver::SpringsOn::one_a_hole; },
     "one spring a hole",
     "design.springs.on = \"one_a_hole\"",
     0.2,
     {"spring_clearance_mm"}},
    {double_one_a_hole,
     "one spring a hole of twice the rate and preload",
     kDoubledOneAHole,
     0.3,
     {"spring_clearance_mm"}}};

const CardKeys kMendedByShifts = {"deploys_from_deg",
                                  "certified_deg",
                                  "first_contact_deg",
                                  "thickness_mm",
                                  "energy_margin",
                                  "static_margin",
                                  "static_friction_n_mm_per_mm",
                                  "pin_margin_in_middle",
                                  "pin_margin_at_ends",
                                  "pin_locks_in_middle_deg",
                                  "pin_locks_at_ends_deg",
                                  "least_stroke_mm",
                                  "stroke",
                                  "yield",
                                  "play_mm"};

// The goal towards a requirement, and that whose bound is the requirement; null: none.
struct GoalTowards {
  std::string_view key;
  const char *goal, *bound;
  bool is_friction = false;  // the requirement is a margin over friction
};
constexpr GoalTowards kGoals[] = {
    {"static_margin", "static_friction_n_mm_per_mm", "static_friction_n_mm_per_mm", true},
    {"static_friction_n_mm_per_mm", "static_friction_n_mm_per_mm", "static_friction_n_mm_per_mm"},
    {"energy_margin", "bent_critical_friction_n_mm_per_mm", "bent_critical_friction_n_mm_per_mm",
     true},
    {"thickness_mm", "thickness_mm", "thickness_mm"},
    {"largest_stress_mpa", "largest_stress_mpa", "largest_stress_mpa"},
    {"buckling_factor", "buckling_factor", "buckling_factor"},
    {"spring_clearance_mm", "spring_clearance_mm", "spring_clearance_mm"},
    {"yield", "miscut_margin_mm", "yield"},
    {"least_stroke_mm", "miscut_margin_mm", nullptr}};

const GoalTowards* goal_row(std::string_view key) {
  const auto* const row = std::ranges::find(kGoals, key, &GoalTowards::key);
  return row == std::end(kGoals) ? nullptr : row;
}

}  // namespace

std::span<const NumberChange> number_changes() { return kNumberChanges; }
std::span<const SwitchChange> switch_changes() { return kSwitchChanges; }

bool is_mended_by_shifts(std::string_view key) {
  return std::ranges::find(kMendedByShifts, key) != kMendedByShifts.end();
}

const char* goal_towards(std::string_view key) {
  const GoalTowards* const row = goal_row(key);
  return row == nullptr ? nullptr : row->goal;
}

std::vector<solver::OptimiseFloor> kept_floors(const schema::Card& card, double friction) {
  std::vector<solver::OptimiseFloor> floors;
  for (const schema::CardLine& line : card.lines) {
    const GoalTowards* const row = goal_row(line.key);
    if (row == nullptr || row->bound == nullptr || !line.is_asked() || !line.passes()) continue;
    const solver::Goal* const goal = solver::goal_named(row->bound);
    const double least = row->is_friction ? friction * (1 + *line.wanted) : *line.wanted;
    const solver::OptimiseFloor floor{goal, goal->in_unit(least)};
    const auto same = std::ranges::find(floors, goal, &solver::OptimiseFloor::goal);
    if (same == floors.end()) {
      floors.push_back(floor);
    } else {
      same->least = std::max(same->least, floor.least);
    }
  }
  return floors;
}

}  // namespace misalign::search
