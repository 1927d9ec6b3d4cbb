#include "search/sheets/deploy_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "schema/exchange/actuators_json.hpp"
#include "schema/pattern/fill_words.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

constexpr double kStandardGravity_mm_per_s2 = 9806.65;

// Reads a whole text as one number.
template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && stop == text.data() + text.size();
}

// "A11-A17=60"
std::pair<int, double> other_rest(const solver::Mechanism& mechanism, const std::string& text) {
  const auto equals = text.find('=');
  double rest_deg = 0;
  const int diagonal =
      equals == std::string::npos ? -1 : diagonal_of_label(mechanism, text.substr(0, equals));
  const bool has_angle = equals != std::string::npos &&
                         read_number(std::string_view(text).substr(equals + 1), rest_deg);
  if (diagonal >= 0 && has_angle && rest_deg >= 0) return {diagonal, rest_deg};
  const std::string named = schema::diagonal_label(mechanism, 0);
  throw schema::UserError(solver::OptionFault{
      "rest", schema::printable(text),
      "is no diagonal with an angle (a diagonal of this sheet is named " + named + ")",
      "write it as " + named + "=60"});
}

UserError no_panel(const std::string& place) {
  return UserError(solver::OptionFault{
      "hold", schema::printable(place),
      "is no panel of this sheet (rows and columns count from 0, and holes cannot be held)",
      "name one as ROW,COLUMN, such as 0,0"});
}

std::array<int, 2> place_of(const std::string& typed) {
  std::array<int, 2> place{};
  const std::string_view text = typed;
  const std::size_t comma = std::min(text.find(','), text.size());
  if (comma < text.size() && read_number(text.substr(0, comma), place[0]) &&
      read_number(text.substr(comma + 1), place[1])) {
    return place;
  }
  throw no_panel(typed);
}

solver::HeldPanel held_panel(const solver::Sheet& sheet, const std::array<int, 2>& place,
                             const std::optional<std::array<double, 3>>& gravity) {
  const std::vector<int>& facets = sheet.panels().facets;
  const auto at = std::ranges::find_if(facets, [&](int facet) {
    const auto& its = sheet.base().sheet.places[static_cast<std::size_t>(facet)];
    return its[0] == place[0] && its[1] == place[1];
  });
  if (at == facets.end()) throw no_panel(fmt::format("{},{}", place[0], place[1]));
  solver::HeldPanel held{static_cast<int>(at - facets.begin())};
  for (std::size_t k = 0; gravity && k < gravity->size(); ++k) {
    held.gravity_mm_per_s2(static_cast<Eigen::Index>(k)) =
        (*gravity)[k] * kStandardGravity_mm_per_s2;
  }
  return held;
}

}  // namespace

int diagonal_of_label(const solver::Mechanism& mechanism, const std::string& label) {
  int d = mechanism.diagonal_count() - 1;
  while (d >= 0 && schema::diagonal_label(mechanism, d) != label) --d;
  return d;
}

double hinge_friction_n_mm_per_mm(const schema::Design& design, const solver::Sheet& sheet) {
  if (design.friction_n_mm_per_mm || !design.film) return design.friction_n_mm_per_mm.value_or(0);
  const solver::FoldingWay* const way = sheet.way();
  if (way == nullptr) return 0;
  double from_deg = design.from_deg.value_or(solver::kDeployFrom_deg);
  if (!design.from_deg && sheet.deploys_from_deg() > 0) {
    from_deg = std::min(from_deg, sheet.deploys_from_deg());
  }
  Eigen::VectorXd folds_rad, rates;
  way->find_creases(way->x_of(std::min(from_deg, way->end_deg())), folds_rad, rates);
  // The mean friction that takes as much energy as those of the creases together.
  const Eigen::VectorXd turned_mm =
      solver::crease_lengths_mm(*way).cwiseProduct(folds_rad.cwiseAbs());
  double taken_n_mm = 0;
  for (Eigen::Index c = 0; c < folds_rad.size(); ++c) {
    taken_n_mm += turned_mm(c) *
                  design.film->friction_n_mm_per_mm(std::abs(folds_rad(c)) / solver::kRadPerDeg);
  }
  return taken_n_mm / turned_mm.sum();
}

solver::ReleaseOptions deploy_options(const schema::Design& design, const solver::Sheet& sheet,
                                      solver::ReleaseOptions options) {
  options.from_deg = design.from_deg;
  options.sheet.fill = design.fill(sheet.base());
  options.sheet.joints.friction_n_mm_per_mm = hinge_friction_n_mm_per_mm(design, sheet);
  options.sheet.joints.stiffness_n_mm_per_mm = design.hinge_elastic_n_mm_per_mm();
  options.sheet.plates = design.plates();
  if (design.hold) {
    options.sheet.held = held_panel(sheet, *design.hold, design.gravity);
  } else if (design.gravity) {
    throw UserError(
        solver::OptionFault{"gravity", fmt::format("{}", fmt::join(*design.gravity, ",")),
                            "needs a panel that is held (a sheet that is free in space only falls)",
                            "add " + schema::parameter("hold", "0,0")});
  }
  return options;
}

solver::ReleaseOptions DeployInput::of(const solver::Sheet& sheet,
                                       const schema::Design& of_file) const {
  schema::Design typed = design;
  if (held) typed.hold = place_of(*held);
  if (gravity.size() == 3) typed.gravity = {gravity[0], gravity[1], gravity[2]};
  solver::ReleaseOptions fitted = deploy_options(typed.merged_over(of_file), sheet, options);
  if (density_g_per_cm3) fitted.sheet.plates.density_g_per_cm3 = *density_g_per_cm3;
  if (!other_rests.empty()) schema::need_springs(fitted.sheet.fill, "other angles of rest");
  for (const std::string& text : other_rests) {
    fitted.sheet.springs().other_rests_deg.push_back(other_rest(sheet.mechanism(), text));
  }
  return fitted;
}

solver::BentPanelsOptions bending(const schema::Design& design) {
  const schema::Material material = design.material.value_or(schema::Material{});
  solver::BentPanelsOptions options;
  options.material = {material.e_gpa, material.poisson};
  // A filling drives the sheet at its angle of rest by preload or pre-stretch alone.
  options.to_deg = design.rest_deg.value_or(0) + design.margin_to_deg.value_or(options.to_deg);
  return options;
}

}  // namespace misalign::search
