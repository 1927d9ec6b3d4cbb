#include "search/sheets/card_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "schema/files/features.hpp"
#include "schema/pattern/fill_words.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/study_texts.hpp"
#include "solver/bending/rest_stiffness.hpp"

namespace misalign::search {
namespace {

// Springs stiffer than these are no advice: a multiple of the design's.
constexpr double kStiffest = 10;

class DriveLines : private CardLines {
 public:
  DriveLines(const CardSheet& on, Advice advice)
      : on_(on), advice_(advice), release_(release_of(on)) {}

  std::vector<schema::CardLine> all() {
    on_.sheet.base().springs.at_vertices() ? bent() : rigid();
    released();
    pins();
    return take();
  }

 private:
  double wanted_energy_margin() const {
    return on_.design.energy_margin.value_or(solver::kWantedMargin);
  }

  void bent() {
    const schema::BentSheet bent = bent_sheet(on_.sheet, release_, on_.design, advice_);
    const std::string bend =
        fmt::format(", bending panels of {:g} mm {}", bent.panels.thickness_mm, bent.material.name);
    const double hinge_friction = release_.sheet.joints.friction_n_mm_per_mm;
    const solver::BentFriction& friction = bent.panels.friction;
    if (on_.stop_deg() == 0) {
      margin("energy_margin", "Energy margin over hinge friction" + bend, wanted_energy_margin(),
             friction.critical_n_mm_per_mm, hinge_friction);
    }
    const Number least = friction.static_n_mm_per_mm;
    margin("static_margin",
           fmt::format("Static margin over hinge friction, down to {:g}°{}",
                       bent.panels.options.to_deg, bend),
           on_.design.static_margin.value_or(solver::kWantedMargin), least, hinge_friction);
    if (on_.stop_deg() == 0) {
      tell("bent_critical_friction_n_mm_per_mm", "Critical friction, bending panels", "N mm/mm",
           friction.critical_n_mm_per_mm);
    } else {
      stop();
    }
    // Plates have to drive the sheet, for their pre-stretch may bend its panels instead; and
    // springs where a static margin is wanted that no friction measures.
    const bool is_driven =
        !on_.design.is_springs() || (on_.design.static_margin && !(hinge_friction > 0));
    ask("static_friction_n_mm_per_mm",
        fmt::format("Static friction overcome, worst at {:.3g}°", friction.static_deg), "N mm/mm",
        is_driven ? Number{0} : Number{}, least, Bound::at_least,
        *least > 0 ? "" : "no moment drives the sheet towards flat there");
    panels(bent);
    if (advice_ == Advice::with) springs_to_choose(bent, hinge_friction);
    at_flat(bent);
  }

  void panels(const schema::BentSheet& bent) {
    ask("largest_stress_mpa",
        fmt::format("Largest static panel stress, farther than {:g} panel widths from corners",
                    solver::kCornerWidths),
        "MPa", bent.material.strength_mpa, bent.panels.most_bent().largest_stress_mpa,
        Bound::at_most);
    const solver::BucklingStudy::Least& pressed = bent.buckling.least();
    if (pressed.kind != solver::BucklingKind::none) {
      ask("buckling_factor",
          fmt::format("Buckling factor of panels, an estimate, least at {:.3g}° in {},{}",
                      pressed.pilot_deg, pressed.place[0], pressed.place[1]),
          "", solver::kWantedBuckling, pressed.factor);
    }
    tell("bent_energy_n_mm", "Stored energy", "N mm", bent.panels.angles.back().bent.n_mm,
         fmt::format("rigid panels: {:.4g} N mm", bent.panels.angles.back().rigid_n_mm));
  }

  void springs_to_choose(const schema::BentSheet& bent, double hinge_friction) {
    const std::optional<double>& useful = bent.advice.useful_stiffness_n_per_mm;
    if (on_.design.is_springs() && useful &&
        *useful <= kStiffest * on_.design.springs().stiffness_n_per_mm) {
      tell("useful_stiffness_n_per_mm",
           fmt::format("Spring rate for {:g} % of the attainable friction", 100 * solver::kUseful),
           "N/mm", useful);
    }
    if (hinge_friction > 0) {
      tell("least_thickness_mm",
           fmt::format("Panel thickness for a static margin of {:g}", bent.advice.wanted_margin),
           "mm", bent.advice.least_thickness_mm,
           bent.advice.least_thickness_mm ? "" : "none; see preload_n");
    }
  }

  // A preload at flat pushes the sheet out of its modes, or holds it.
  void at_flat(const schema::BentSheet& bent) {
    if (!bent.preload) return;
    const solver::FlatModes& modes = bent.preload->modes;
    const bool is_held = on_.design.hold_flat.value_or(false);
    ask(schema::kUnstableAtFlat, "Unstable rigid-folding modes at flat", "",
        is_held ? Number{} : Number{0}, modes.unstable, Bound::at_most,
        modes.unstable == 0 ? ""
        : is_held
            ? fmt::format("of {}, by the preload: a stop, latch or frame is a part of the design",
                          modes.rigid)
            : fmt::format("of {}, by the preload: a stop, latch or frame must hold the sheet",
                          modes.rigid));
  }

  void stop() {
    const auto stiffness =
        solver::rest_stiffness(on_.sheet, release_, bending(on_.design).material);
    tell("rest_stiffness_n_mm_per_rad",
         fmt::format("Rotational stiffness at the stop, {:g}°, bending panels", on_.stop_deg()),
         "N mm/rad", stiffness ? Number(stiffness->n_mm_per_rad) : std::nullopt,
         stiffness ? "" : "not known with a preload or pre-stretch");
  }

  // Panels are bent by springs on the vertices alone.
  void rigid() {
    constexpr char kNeeds[] = "bending panels and a static margin need springs on the vertices";
    if (on_.stop_deg() > 0) {
      tell("static_margin", "Static margin over hinge friction", "", {}, kNeeds);
      return;
    }
    const solver::StaticRelease study = value_or_throw(solver::static_release(on_.sheet, release_),
                                                       on_.sheet.name(), "it has no card");
    margin("energy_margin", "Energy margin over hinge friction, rigid panels",
           wanted_energy_margin(), study.friction.critical_n_mm_per_mm,
           release_.sheet.joints.friction_n_mm_per_mm);
    last().note = kNeeds;
  }

  void released() {
    const Number wanted = on_.design.landing_deg_per_s;
    if (!has("SUNDIALS")) {
      ask("landing_deg_per_s", "Landing speed, rigid panels", "deg/s", wanted, {}, Bound::at_most,
          schema::missing_text("SUNDIALS"));
      return;
    }
    const double stop_deg = on_.stop_deg();
    const solver::DeploymentStudy study = deployed(on_.sheet, release_);
    Number rate, energy;
    for (const solver::Deployment::Row& row : study.run.rows) {
      if (stop_deg > 0 ? row.pilot_deg > stop_deg : row.event != solver::Deployment::Event::flat) {
        continue;
      }
      rate = std::abs(row.rate_deg_per_s);
      energy = row.kinetic_n_mm;
      break;
    }
    ask("landing_deg_per_s", "Landing speed, rigid panels", "deg/s", wanted, rate, Bound::at_most,
        rate           ? ""
        : stop_deg > 0 ? "the sheet does not reach its stop"
                       : "the sheet does not reach flat");
    tell("landing_energy_n_mm", "Landing energy, taken by a latch", "N mm", energy);
    tell("mass_g", "Panel mass", "g", study.mass_t * 1e6);
  }

  // Pins are required to overcome their friction by energy, and not to lock in slow motion.
  void pins() {
    const auto study = pins_of(on_.sheet, release_, on_.design);
    if (!study || on_.stop_deg() > 0) return;
    const double to_deg = bending(on_.design).to_deg;
    for (const auto& [pins, key, locks, where] :
         {std::tuple(&study->in_middle, "pin_margin_in_middle", "pin_locks_in_middle_deg",
                     "a pin in the middle of each hinge"),
          std::tuple(&study->at_ends, "pin_margin_at_ends", "pin_locks_at_ends_deg",
                     "a pin at each end")}) {
      margin(key, fmt::format("Energy margin over pin friction, {}, rigid panels", where),
             wanted_energy_margin(), pins->critical_mm, study->own_mm);
      if (study->own_mm <= 0) continue;
      ask(locks, fmt::format("Locking angle in slow motion, {}", where), "deg", to_deg,
          pins->stall_deg(study->own_mm).value_or(to_deg), Bound::at_most);
    }
  }

  const CardSheet& on_;
  const Advice advice_;
  const solver::ReleaseOptions release_;
};

}  // namespace

std::vector<schema::CardLine> drive_lines(const CardSheet& on, Advice advice) {
  return DriveLines(on, advice).all();
}

solver::ReleaseOptions release_of(const CardSheet& on) {
  solver::ReleaseOptions release = deploy_options(on.design, on.sheet);
  release.from_deg = on.used_deg;
  // The last sample that the way reaches, if that is less.
  const solver::FoldingWay* const way = on.sheet.way();
  if (way != nullptr && on.used_deg >= way->end_deg()) {
    const double sample_deg = on.chosen.sampling.sample_deg;
    release.from_deg =
        std::min(on.used_deg, sample_deg * (std::ceil(way->end_deg() / sample_deg) - 1));
  }
  return release;
}

}  // namespace misalign::search
