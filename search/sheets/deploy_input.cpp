#include "search/sheets/deploy_input.hpp"

#include <algorithm>
#include <charconv>

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/features.hpp"
#include "search/sheets/found_study.hpp"

namespace misalign::search {
namespace {

constexpr double kStandardGravity_mm_per_s2 = 9806.65;

// All of a text as one number.
template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && stop == text.data() + text.size();
}

// "A11-A17=60"
std::pair<int, double> other_rest(const solver::Mechanism& mechanism, const std::string& text) {
  const auto equals = text.find('=');
  double rest_deg = 0;
  int diagonal = -1;
  for (int d = 0; d < mechanism.diagonal_count() && equals != std::string::npos; ++d) {
    if (text.substr(0, equals) == schema::diagonal_label(mechanism, d)) diagonal = d;
  }
  const bool has_angle = equals != std::string::npos &&
                         read_number(std::string_view(text).substr(equals + 1), rest_deg);
  if (diagonal >= 0 && has_angle && rest_deg >= 0) return {diagonal, rest_deg};
  const std::string named = schema::diagonal_label(mechanism, 0);
  throw schema::UserError(solver::OptionFault{
      "rest", schema::printable(text),
      "is no diagonal with an angle (a diagonal of this sheet is named " + named + ")",
      "write it as " + named + "=60"});
}

solver::HeldPanel held_panel(const solver::Sheet& sheet, const std::string& place,
                             const std::vector<double>& gravity) {
  int row = 0, column = 0, panel = -1;
  const std::vector<int>& facets = sheet.panels().facets;
  const std::string_view text = place;
  const std::size_t comma = std::min(text.find(','), text.size());
  if (comma < text.size() && read_number(text.substr(0, comma), row) &&
      read_number(text.substr(comma + 1), column)) {
    for (std::size_t k = 0; k < facets.size(); ++k) {
      const auto& at = sheet.base().sheet.places[static_cast<std::size_t>(facets[k])];
      if (at[0] == row && at[1] == column) panel = static_cast<int>(k);
    }
  }
  if (panel < 0) {
    throw schema::UserError(solver::OptionFault{
        "hold", schema::printable(place),
        "is no panel of this sheet (rows and columns count from 0, and holes cannot be "
        "held)",
        "name one as ROW,COLUMN, such as 0,0"});
  }
  solver::HeldPanel held{panel};
  for (std::size_t k = 0; k < gravity.size(); ++k) {
    held.gravity_mm_per_s2(static_cast<Eigen::Index>(k)) = gravity[k] * kStandardGravity_mm_per_s2;
  }
  return held;
}

}  // namespace

solver::DeployOptions DeployInput::of(const solver::Sheet& sheet,
                                      const solver::Actuators& actuators) const {
  solver::DeployOptions fitted = options;
  fitted.sheet.springs.stiffness_n_per_mm =
      stiffness_n_per_mm.value_or(actuators.stiffness_n_per_mm);
  for (const std::string& text : other_rests) {
    fitted.sheet.springs.other_rests_deg.push_back(other_rest(sheet.mechanism(), text));
  }
  if (held) fitted.sheet.held = held_panel(sheet, *held, gravity);
  return fitted;
}

solver::DeploymentStudy deployed(const solver::Sheet& sheet, const solver::DeployOptions& options) {
  schema::need("SUNDIALS");
  return found(solver::deploy(sheet, options),
               sheet.name() +
                   ": its folding path is lost (a numerical failure), so it cannot be let go; "
                   "`misalign fold` says how far it is known");
}

solver::BentPanels bent_panels(const solver::Sheet& sheet, const solver::DeployOptions& deploying,
                               const solver::BentPanelsOptions& options) {
  return found(
      solver::bend_panels(sheet, deploying, options),
      sheet.name() +
          ": its folding path is lost (a numerical failure), so its panels cannot be bent; "
          "`misalign fold` says how far it is known");
}

}  // namespace misalign::search
