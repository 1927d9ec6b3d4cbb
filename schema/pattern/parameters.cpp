#include "schema/pattern/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace misalign::schema {
namespace {

struct Parameter {
  std::string_view study, name;
  DesignLimits bounds;
};

constexpr Parameter kParameters[] = {{"", "jobs", {1, 4096}},
                                     {"", "trim_mm", {0, 1e6}},
                                     {"actuators", "equal_lengths_share", {1e-3, 1}},
                                     {"actuators", "fewest_margin", {0, 1e6}},
                                     {"actuators", "free_within", {0, 0.5}},
                                     {"actuators", "least_link_mm", {0, 1e6}},
                                     {"actuators", "link_step_mm", {1e-2, 1e4}},
                                     {"actuators", "most_rate_n_per_mm", {1e-6, 1e6}},
                                     {"actuators", "most_springs", {1, 10000}},
                                     {"actuators", "rates_n_per_mm", {1e-6, 1e6}},
                                     {"card", "trials", {1, kMostBacklashTrials}},
                                     {"contact", "end_mm", {0, 1e6}},
                                     {"optimise", "amplitude_mm", {1e-6, 1e6}},
                                     {"optimise", "deploys_from_deg", {0.01, 180}},
                                     {"optimise", "grid_mm", {1e-6, 1e3}},
                                     {"optimise", "least_slope_mm_per_deg", {0, 1e6}},
                                     {"optimise", "miscut_mm", {1e-6, 1e3}},
                                     {"optimise", "rest_deg", {0, 180}},
                                     {"optimise", "steps", {1, 1e5}},
                                     {"optimise", "trials", {1, 1e6}},
                                     {"tolerance", "trials", {1, 1e8}}};

void check_within(std::string_view name, const DesignLimits& bounds, double value) {
  const auto [least, most] = bounds;
  if (value >= least && value <= most) return;  // false for NaN
  throw UserError(solver::OptionFault{
      std::string(name), fmt::format("{:g}", value),
      fmt::format("is not a number from {} to {}", shown_number(least), shown_number(most)),
      "give one within these bounds"});
}

}  // namespace

DesignLimits parameter_limits(std::string_view study, std::string_view name) {
  const auto* const found = std::ranges::find_if(kParameters, [&](const Parameter& entry) {
    return entry.study == study && entry.name == name;
  });
  assert(found != std::end(kParameters));
  return found->bounds;
}

void check_parameter(std::string_view study, std::string_view name, double value) {
  check_within(name, parameter_limits(study, name), value);
}

void check_design(std::string_view name, std::string_view design_key, double value) {
  check_within(name, design_limits(design_key), value);
}

}  // namespace misalign::schema
