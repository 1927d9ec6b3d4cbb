#include "schema/campaign/optimise_bounds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <regex>

#include "schema/files/suggestion.hpp"
#include "schema/pattern/design.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kStroke = "stroke_max";
constexpr const char* kForce = "largest_force_n";

struct Ceiling {
  const char* name;
  std::optional<double> OptimiseBounds::*bound;
  std::string_view design_key;  // key of the design with the same bounds
};
constexpr Ceiling kCeilings[] = {
    {kStroke, &OptimiseBounds::stroke_max, "springs.stroke_limit"},
    {kForce, &OptimiseBounds::largest_force_n, "springs.largest_force_n"}};
constexpr double kMostFloor = 1e9;

std::vector<std::string> limited_names() {
  std::vector<std::string> names = {kStroke, kForce};
  for (const std::string& goal : solver::goal_names()) names.push_back(goal);
  return names;
}

BoundFault out_of_bounds(const std::string& name, double least, double most) {
  return {fmt::format("{} is limited to between {} and {}", name, shown_number(least),
                      shown_number(most)),
          "write another number"};
}

}  // namespace

std::optional<BoundFault> add_bound(const std::string& text, OptimiseBounds& bounds) {
  static const std::regex form(R"(\s*([A-Za-z0-9_]+)\s*(<=|>=)\s*([-+.0-9eE]+)\s*)");
  constexpr const char* kForms = "write \"stroke_max <= 0.06\" or \"miscut_margin_mm >= 0.1\"";
  std::smatch part;
  double bound = 0;
  const auto is_number = [&](const std::string& number) {
    const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), bound);
    return error == std::errc{} && stop == number.data() + number.size();
  };
  // Longer texts are no constraint, and would exhaust the matcher's stack.
  constexpr std::size_t kLongest = 200;
  if (text.size() > kLongest || !std::regex_match(text, part, form) || !is_number(part[3])) {
    return BoundFault{"is no constraint", kForms};
  }
  const std::string name = part[1];
  const bool is_ceiling = part[2] == "<=";
  const auto twice = [&] { return BoundFault{"limits " + name + " twice", "write one of them"}; };
  for (const Ceiling& ceiling : kCeilings) {
    if (name != ceiling.name) continue;
    if (!is_ceiling) return BoundFault{name + " needs an upper bound", "write " + name + " <= it"};
    const auto [least, most] = design_limits(ceiling.design_key);
    if (!(bound >= least && bound <= most)) return out_of_bounds(name, least, most);
    if (bounds.*ceiling.bound) return twice();
    bounds.*ceiling.bound = bound;
    return {};
  }
  const solver::Goal* const goal = solver::goal_named(name);
  if (!goal) {
    return BoundFault{unknown_word(name, "number that can be limited", limited_names()),
                      fmt::format("name one of {}", fmt::join(limited_names(), ", "))};
  }
  if (is_ceiling != goal->is_to_be_small) {
    return BoundFault{fmt::format("{} needs {} bound", name, is_ceiling ? "a lower" : "an upper"),
                      fmt::format("write {} {} it", name, goal->relation())};
  }
  if (!(bound >= 0 && bound <= kMostFloor)) return out_of_bounds(name, 0, kMostFloor);
  if (std::ranges::count(bounds.floors, goal, &solver::OptimiseFloor::goal)) return twice();
  bounds.floors.push_back({goal, goal->in_unit(bound)});
  std::ranges::sort(bounds.floors, {}, &solver::OptimiseFloor::goal);
  return {};
}

OptimiseBounds bounds_of(const std::vector<std::string>& subject_to) {
  OptimiseBounds bounds;
  for (const std::string& text : subject_to) {
    const auto fault = add_bound(text, bounds);
    if (!fault) continue;
    throw UserError(
        solver::OptionFault{"subject_to", printable(text), fault->why, fault->suggestion});
  }
  return bounds;
}

Json bounds_json(const OptimiseBounds& bounds) {
  Json list = Json::array();
  for (const Ceiling& ceiling : kCeilings) {
    if (bounds.*ceiling.bound) {
      list.push_back(fmt::format("{} <= {}", ceiling.name, *(bounds.*ceiling.bound)));
    }
  }
  for (const auto& [goal, least] : bounds.floors) {
    list.push_back(fmt::format("{} {} {}", goal->name, goal->relation(), goal->in_unit(least)));
  }
  return list;
}

}  // namespace misalign::schema
