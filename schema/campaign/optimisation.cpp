#include "schema/campaign/optimisation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "schema/files/json_values.hpp"
#include "schema/files/suggestion.hpp"
#include "schema/pattern/design.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kOfOneSheet =
    "comes from libraries whose last digits differ between machines, and so would optima";

void read_goal(ObjectReader& reader, const solver::Goal*& goal) {
  std::string name(goal->name);
  const std::vector<std::string> usable = solver::goal_names(&solver::Goal::is_same_everywhere);
  const std::string named = fmt::format("name one of {}", fmt::join(usable, ", "));
  reader.text("maximise", name, named);
  const solver::Goal* const found = solver::goal_named(name);
  if (!found) {
    reader.faults().add(reader.shown("maximise"), unknown_word(name, "goal", usable), named);
  } else if (!found->is_same_everywhere) {
    reader.faults().add(reader.shown("maximise"), kOfOneSheet,
                        named + ", or use `misalign optimise` on single sheets");
  } else {
    goal = found;
  }
}

void read_limits(ObjectReader& reader, OptimiseBounds& limits) {
  const Json* list = reader.find("subject_to");
  if (!list) return;
  InputFaults& faults = reader.faults();
  const std::size_t before = faults.count();
  constexpr std::size_t kMost = 16;
  if (!list->is_array() || list->size() > kMost) {
    faults.add(reader.shown("subject_to"), "is no list of up to 16 constraints",
               "write [\"stroke_max <= 0.06\"], or [] for none");
    return;
  }
  for (const Json& limit : *list) {
    const auto fault = limit.is_string() ? add_bound(limit.get<std::string>(), limits)
                                         : BoundFault{"is no text", "write \"stroke_max <= 0.06\""};
    if (fault)
      faults.add(reader.name("subject_to") + " has " + shortened(limit.dump(), 80), fault->why,
                 fault->suggestion);
  }
  for (const auto& [goal, least] : limits.floors) {
    if (goal->is_same_everywhere || faults.count() > before) continue;
    faults.add(reader.name("subject_to") + " has " + std::string(goal->name), kOfOneSheet,
               "take it out, or use `misalign optimise` on single sheets");
  }
}

// Reads a key that the design block has, too, within the same bounds.
template <class Number>
void read_as_design(ObjectReader& reader, const char* key, std::string_view design_key,
                    Number& into, const char* suggestion) {
  const auto [least, most] = design_limits(design_key);
  reader.number(key, into, least, most, suggestion);
}

}  // namespace

Optimisation read_optimisation(ObjectReader& reader, double threshold_deg) {
  Optimisation optimisation;
  read_goal(reader, optimisation.goal);
  read_limits(reader, optimisation.bounds);
  read_as_design(reader, "from_deg", "from_deg", optimisation.from_deg,
                 "try 36, or null for goals that need none");
  read_as_design(reader, "stiffness_n_per_mm", "springs.stiffness_n_per_mm",
                 optimisation.stiffness_n_per_mm, "try 50, the paper's springs");
  read_as_design(reader, "preload_n", "springs.preload_n", optimisation.preload_n,
                 "try 3: the force of each spring at flat");
  std::string shifts = "free";
  reader.text("shifts", shifts, "write \"free\" or \"ternary\"");
  if (shifts != "free" && shifts != "ternary") {
    reader.faults().add(reader.shown("shifts"), "are no shifts", "write \"free\" or \"ternary\"");
  }
  optimisation.ternary = shifts == "ternary";
  reader.number("grid_mm", optimisation.grid_mm, 1e-6, 1e3,
                "try 0.01, a cutter's step, or null for none");
  reader.number("least_slope_mm_per_deg", optimisation.least_slope_mm_per_deg, 0, 1e6, "try 0.001");
  reader.count("most_steps", optimisation.most_steps, 1, 100000, "leaves every draw as it is");
  reader.count("starts_of_population", optimisation.starts_of_population, 1, 1000000,
               "leaves no start");
  if (optimisation.from_deg && *optimisation.from_deg > threshold_deg) {
    reader.faults().add(reader.shown("from_deg"),
                        "lies above accept.deploys_from_deg = " + shown_number(threshold_deg),
                        "try " + shown_number(std::min(36.0, threshold_deg)));
  }
  return optimisation;
}

void check_optimisation(ObjectReader& reader, const Optimisation& optimisation) {
  const OptimiseBounds& limits = optimisation.bounds;
  const bool lets_go =
      optimisation.goal->is_of_use || limits.largest_force_n ||
      std::ranges::any_of(limits.floors, &solver::Goal::is_of_use, &solver::OptimiseFloor::goal);
  if (lets_go && !optimisation.from_deg) {
    reader.faults().add(reader.name("from_deg"), "is missing, the release angle of the sheets",
                        "write a pilot angle, such as 36");
  }
  if (optimisation.goal->chooses_springs && optimisation.preload_n != 0) {
    reader.faults().add(reader.shown("preload_n"),
                        std::string("has no effect on ") + std::string(optimisation.goal->name) +
                            ", which chooses a free length for each spring",
                        "take it out");
  }
  if (optimisation.ternary && optimisation.grid_mm) {
    reader.faults().add(reader.shown("grid_mm"), "applies only to free shifts", "take it out");
  }
  for (const auto& [goal, least] : limits.floors) {
    if (goal != optimisation.goal) continue;
    reader.faults().add(reader.name("subject_to"),
                        std::string(goal->name) + " is the objective already", "take it out");
  }
}

Json optimisation_json(const Optimisation& optimisation) {
  return {{"maximise", optimisation.goal->name},
          {"subject_to", bounds_json(optimisation.bounds)},
          {"from_deg", or_null(optimisation.from_deg)},
          {"stiffness_n_per_mm", optimisation.stiffness_n_per_mm},
          {"preload_n", optimisation.preload_n},
          {"shifts", optimisation.ternary ? "ternary" : "free"},
          {"grid_mm", or_null(optimisation.grid_mm)},
          {"least_slope_mm_per_deg", optimisation.least_slope_mm_per_deg},
          {"most_steps", optimisation.most_steps},
          {"starts", "draws"},
          {"starts_of_population", optimisation.starts_of_population}};
}

}  // namespace misalign::schema
