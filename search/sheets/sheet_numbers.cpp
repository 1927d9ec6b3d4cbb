#include "search/sheets/sheet_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "schema/pattern/target.hpp"
#include "search/sheets/deploy_input.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/deploy.hpp"
#include "solver/optimise/chosen_friction.hpp"
#include "solver/shape/surface_curvature.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::search {
namespace {

using Number = std::optional<double>;

// Results of studies; each is computed where a wanted number needs it.
struct Found {
  std::optional<solver::StaticRelease> standstill;
  Number springs_n_mm;
  std::optional<solver::DeploymentStudy> motion;
  std::optional<solver::ContactStudy> contact;
  std::optional<solver::BentPanels> bent;
  std::optional<solver::SpringChoice> choice;
  std::optional<solver::SurfaceCurvature> curvature;
  std::optional<solver::ShapeMisfit> off_shape;
  Number stop_mm2_per_rad2;  // sum of (dL/drho)^2 over all diagonals where it has the shape
};
enum class Needs { standstill, springs, motion, contact, bent, choice, curvature, shape, stop };

struct StudyFunction {
  std::string_view name;  // in the table of studies
  Needs needs;
  bool from_d;  // true if the default angle of use is D, otherwise that of `deploy`
  Number (*number)(const Found&);
};

Number first_contact_deg(const Found& found) {
  if (!found.contact || !found.contact->first) return {};
  return found.contact->first->pilot_deg;
}

// Panels that meet on the way leave no thickness.
Number thickness_mm(const Found& found) {
  if (!found.contact || !found.contact->thickness) return {};
  const solver::ContactStudy& study = *found.contact;
  return study.reach_deg < study.used_from_deg ? 0 : study.thickness->thickness_mm;
}

Number landing_rate_deg_per_s(const Found& found) {
  if (!found.motion) return {};
  for (const solver::Deployment::Row& row : found.motion->run.rows) {
    if (row.event == solver::Deployment::Event::flat) return std::abs(row.rate_deg_per_s);
  }
  return {};
}

template <std::size_t kWhich>
Number curvature_per_m(const Found& found) {
  constexpr double kMmPerM = 1000;
  return found.curvature ? kMmPerM * found.curvature->per_mm[kWhich] : Number();
}

// The stiffness of a stop there by springs of 1 N/mm; none where the sheet does not fold to it.
Number stop_mm2_per_rad2(const solver::Sheet& sheet, double at_deg) {
  if (!sheet.way() || sheet.way()->end_deg() <= at_deg) return {};
  const solver::FoldingWay& way = *sheet.way();
  Eigen::VectorXd lengths_mm, rates_mm;
  const double x = way.x_of(at_deg), rate = way.pilot_rate(x);
  way.find_lengths(x, lengths_mm, rates_mm);
  return rates_mm.squaredNorm() / (rate * rate);
}

constexpr StudyFunction kFunctions[] = {
    {"deploy_time_s", Needs::motion, false,
     [](const Found& found) { return found.motion ? found.motion->deploy_time_s() : Number(); }},
    {"landing_rate_deg_per_s", Needs::motion, false, landing_rate_deg_per_s},
    {"critical_friction_n_mm_per_mm", Needs::standstill, false,
     [](const Found& found) {
       return found.standstill ? found.standstill->friction.critical_n_mm_per_mm : Number();
     }},
    {"stall_deg", Needs::standstill, false,
     [](const Found& found) {
       return found.standstill ? Number(found.standstill->friction.static_stall_deg) : Number();
     }},
    {"bent_energy_n_mm", Needs::bent, false,
     [](const Found& found) {
       return found.bent ? Number(found.bent->angles.back().bent.n_mm) : Number();
     }},
    {"bent_critical_friction_n_mm_per_mm", Needs::bent, false,
     [](const Found& found) {
       return found.bent ? found.bent->friction.critical_n_mm_per_mm : Number();
     }},
    {"static_friction_n_mm_per_mm", Needs::bent, false,
     [](const Found& found) {
       return found.bent ? Number(found.bent->friction.static_n_mm_per_mm) : Number();
     }},
    {"static_margin", Needs::bent, false,
     [](const Found& found) { return found.bent ? found.bent->friction.static_margin : Number(); }},
    {"energy_n_mm", Needs::springs, true, [](const Found& found) { return found.springs_n_mm; }},
    {"chosen_friction_n_mm_per_mm", Needs::choice, true,
     [](const Found& found) {
       return found.choice && found.choice->drives() ? Number(found.choice->static_n_mm_per_mm)
                                                     : Number();
     }},
    {"first_contact_deg", Needs::contact, true, first_contact_deg},
    {"thickness_mm", Needs::contact, true, thickness_mm},
    {"curvature_1_per_m", Needs::curvature, true, curvature_per_m<0>},
    {"curvature_2_per_m", Needs::curvature, true, curvature_per_m<1>},
    {"shape_rms_mm", Needs::shape, false,
     [](const Found& found) {
       return found.off_shape ? Number(found.off_shape->rms_mm()) : Number();
     }},
    {"shape_max_mm", Needs::shape, false,
     [](const Found& found) {
       return found.off_shape ? Number(found.off_shape->max_mm()) : Number();
     }},
    {"stop_stiffness_mm2_per_rad2", Needs::stop, false,
     [](const Found& found) { return found.stop_mm2_per_rad2; }}};
static_assert(std::size(kFunctions) == kNumberCount);

using Needed = std::array<bool, 9>;  // by Needs

Found find(const solver::Sheet& sheet, const schema::Design& design,
           const solver::ReleaseOptions& options, std::optional<double> from_deg,
           const Needed& needed, const schema::Target* target) {
  const auto needs = [&](Needs what) { return needed[static_cast<std::size_t>(what)]; };
  Found found;
  if (needs(Needs::standstill)) found.standstill = solver::static_release(sheet, options).if_any();
  if (needs(Needs::springs)) found.springs_n_mm = solver::springs_n_mm(sheet, options);
  if (needs(Needs::motion)) found.motion = solver::deploy(sheet, options).if_any();
  if (needs(Needs::contact)) found.contact = solver::contact(sheet, {{}, from_deg}).if_any();
  if (needs(Needs::bent)) {
    found.bent = solver::bend_panels(sheet, options, bending(design)).if_any();
  }
  if (needs(Needs::choice) && std::holds_alternative<solver::Springs>(options.sheet.fill)) {
    found.choice =
        solver::choose_springs(sheet, solver::choice_of(options, bending(design).to_deg)).if_any();
  }
  if (needs(Needs::curvature)) {
    found.curvature = solver::surface_curvature(sheet, from_deg.value_or(sheet.deploys_from_deg()));
  }
  if (needs(Needs::shape) && target) {
    found.off_shape = solver::shape_misfit_of(sheet, target->shape, *target->at_deg);
  }
  if (needs(Needs::stop) && target) {
    found.stop_mm2_per_rad2 = stop_mm2_per_rad2(sheet, *target->at_deg);
  }
  return found;
}

}  // namespace

const std::array<std::string_view, kNumberCount>& sheet_number_names() {
  static const auto names = [] {
    std::array<std::string_view, kNumberCount> all;
    for (std::size_t k = 0; k < kNumberCount; ++k) all[k] = kFunctions[k].name;
    return all;
  }();
  return names;
}

bool needs_sundials(std::size_t number) { return kFunctions[number].needs == Needs::motion; }

StudyNumbers find_numbers(const solver::Sheet& sheet, const schema::Design& design,
                          std::optional<double> from_deg, const WantedNumbers& wanted,
                          bool is_candidate, const schema::Target* target) {
  StudyNumbers answers;
  const auto used_deg = from_deg ? from_deg : design.from_deg;
  for (const bool from_d : {false, true}) {
    Needed needed{};
    for (std::size_t k = 0; k < kNumberCount; ++k) {
      if (wanted[k] && kFunctions[k].from_d == from_d) {
        needed[static_cast<std::size_t>(kFunctions[k].needs)] = true;
      }
    }
    if (std::ranges::find(needed, true) == needed.end()) continue;
    schema::Design used = design;
    used.from_deg = used_deg;
    if (!used_deg && from_d) used.from_deg = sheet.deploys_from_deg();
    if (!used_deg && !from_d && is_candidate) used.from_deg = solver::kDeployFrom_deg;
    const solver::ReleaseOptions options = deploy_options(used, sheet);
    const Found found = find(sheet, design, options, used_deg, needed, target);
    for (std::size_t k = 0; k < kNumberCount; ++k) {
      if (!wanted[k] || kFunctions[k].from_d != from_d) continue;
      answers.is_found[k] = true;
      answers.numbers[k] = kFunctions[k].number(found);
    }
  }
  return answers;
}

}  // namespace misalign::search
