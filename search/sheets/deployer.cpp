#include "search/sheets/deployer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/features.hpp"
#include "search/draws/models.hpp"
#include "solver/records/path_record.hpp"
#include "solver/sheet/panels.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

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
  throw UserError(
      schema::Cause::bad_request,
      fmt::format("--rest {}: is no diagonal with an angle (a diagonal of this sheet is "
                  "named {}); write it as {}=60",
                  schema::printable(text), schema::diagonal_label(mechanism, 0),
                  schema::diagonal_label(mechanism, 0)));
}

solver::HeldPanel held_panel(const schema::Pattern& base, const solver::Mechanism& mechanism,
                             const std::string& place, const std::vector<double>& gravity) {
  int row = 0, column = 0, panel = -1;
  const solver::Panels panels = solver::panels_of(base.base, mechanism);
  const std::string_view text = place;
  const std::size_t comma = std::min(text.find(','), text.size());
  if (comma < text.size() && read_number(text.substr(0, comma), row) &&
      read_number(text.substr(comma + 1), column)) {
    for (std::size_t k = 0; k < panels.facets.size(); ++k) {
      const auto& at = base.base.sheet.places[static_cast<std::size_t>(panels.facets[k])];
      if (at[0] == row && at[1] == column) panel = static_cast<int>(k);
    }
  }
  if (panel < 0) {
    throw UserError(schema::Cause::bad_request,
                    fmt::format("--hold {}: is no panel of this sheet (rows and columns count from "
                                "0, and holes cannot be held); name one as ROW,COLUMN, such as 0,0",
                                schema::printable(place)));
  }
  solver::HeldPanel held{panel};
  for (std::size_t k = 0; k < gravity.size(); ++k) {
    held.gravity_mm_per_s2(static_cast<Eigen::Index>(k)) = gravity[k] * kStandardGravity_mm_per_s2;
  }
  return held;
}

}  // namespace

Deployer::Deployer(const schema::Pattern& base, const schema::Sampling& sampling,
                   const solver::Actuators& actuators, const DeployWish& wish)
    : base_(base),
      sample_deg_(sampling.sample_deg),
      from_is_wished_(wish.from_deg.has_value()),
      model_(model_of(base, sampling)),
      sheet_(wish.sheet),
      options_(wish.options),
      forces_(wish.forces),
      ways_(model_) {
  options_.from_deg = wish.from_deg.value_or(kDeployFrom_deg);
  sheet_.springs.stiffness_n_per_mm =
      wish.stiffness_n_per_mm.value_or(actuators.stiffness_n_per_mm);
  for (const std::string& text : wish.other_rests) {
    sheet_.springs.other_rests_deg.push_back(other_rest(mechanism(), text));
  }
  if (wish.held) sheet_.held = held_panel(base, mechanism(), *wish.held, wish.gravity);
}

void Deployer::check_angles(const solver::FoldingWay& way, double from_deg,
                            const std::string& name) const {
  double end_deg = way.end_deg();
  std::string reason =
      way.ends_at_limit() ? "reaches its fold limit" : "is followed no farther than";
  if (const auto over_deg = way.over_folded_deg(); over_deg && *over_deg < end_deg) {
    end_deg = *over_deg;
    reason = "has a crease folded to 180 deg";
  }
  const auto check = [&](const std::string& option, double wished_deg) {
    if (wished_deg < end_deg) return;
    throw UserError(schema::Cause::bad_request,
                    fmt::format("{} {:g}: {} {} at {:.4f} deg; name a smaller angle", option,
                                wished_deg, name, reason, end_deg));
  };
  check("--from", from_deg);
  check("--rest-deg", sheet_.springs.rest_deg);
  check("--hinge-rest", sheet_.joints.rest_deg);
  for (const auto& [diagonal, rest_deg] : sheet_.springs.other_rests_deg) {
    check("--rest " + schema::diagonal_label(mechanism(), diagonal) + "=", rest_deg);
  }
}

double Deployer::deploys_from_deg(const Eigen::Matrix2Xd& shifts_mm) const {
  const solver::FlatVertices vertices_mm = base_.base.sheet.vertices_mm + shifts_mm;
  return solver::record_path(model_, vertices_mm).verdict.deploys_from_sample * sample_deg_;
}

std::optional<solver::DeploymentStudy> Deployer::study_if_possible(
    const Eigen::Matrix2Xd& shifts_mm, double deploys_from_deg) {
  try {
    return study(shifts_mm, deploys_from_deg, "the sheet");
  } catch (const schema::UserError&) {
    return {};
  }
}

solver::DeploymentStudy Deployer::study(const Eigen::Matrix2Xd& shifts_mm, double deploys_from_deg,
                                        const std::string& name) {
  schema::need("SUNDIALS");
  const auto way = ways_.follow(base_.base.sheet.vertices_mm + shifts_mm);
  if (!way) {
    throw UserError(schema::Cause::failure,
                    name +
                        ": its folding path is lost (a numerical failure), so it cannot be let "
                        "go; `misalign fold` says how far it is known");
  }
  solver::DeploymentOptions options = options_;
  if (!from_is_wished_ && deploys_from_deg > 0) {
    options.from_deg = std::min(options.from_deg, deploys_from_deg);
  }
  check_angles(*way, options.from_deg, name);
  solver::DeploymentStudy study = solver::study_deployment(*way, model_, sheet_, options, forces_);
  const solver::JointResistance& joints = sheet_.joints;
  if (joints.damping_n_mm_s_per_mm > 0) {
    study.friction.critical_n_mm_per_mm =
        solver::critical_friction_in_motion(*way, model_, sheet_, options);
  }
  return study;
}

}  // namespace misalign::search
