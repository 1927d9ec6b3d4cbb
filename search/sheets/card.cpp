#include "search/sheets/card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/files/features.hpp"
#include "schema/pattern/fill_words.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "search/sheets/card_contact.hpp"
#include "search/sheets/card_copies.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/study_texts.hpp"
#include "solver/bending/rest_stiffness.hpp"
#include "solver/certificate/member_proof.hpp"
#include "solver/contact/least_box.hpp"
#include "solver/records/strokes.hpp"
#include "solver/sheet/energy_history.hpp"

namespace misalign::search {
namespace {

using schema::CardLine;
using Bound = CardLine::Bound;
using Number = std::optional<double>;

class CardMaker {
 public:
  CardMaker(const Subject& subject, const CardOptions& options)
      : chosen_(subject.chosen),
        sheet_(subject.sheet),
        design_(subject.model.design()),
        options_(options) {
    const double d_deg = sheet_.deploys_from_deg();
    if (d_deg <= 0) {
      throw schema::UserError(schema::Cause::bad_input,
                              sheet_.name() +
                                  ": the sheet does not deploy (D = 0), so it has no card; "
                                  "`misalign fold` shows its first fault");
    }
    used_deg_ = std::min(design_.from_deg.value_or(d_deg), d_deg);
    const Number from_deg = used_deg_ < d_deg ? Number(used_deg_) : std::nullopt;
    springs_ = solver::actuate(sheet_, actuators_on(sheet_, design_, from_deg), from_deg);
    need_energy(sheet_, design_.fill(sheet_.base()), "it has no card");
    release_ = deploy_options(design_, sheet_);
    release_.from_deg = release_deg();
  }

  StudiedCard make() {
    geometry();
    sheet_.base().springs.at_vertices() ? bent() : rigid();
    released();
    pins();
    springs();
    for (schema::CardLine& line :
         copy_lines(chosen_, sheet_, design_, used_deg_, {options_.trials, options_.jobs})) {
      lines_.push_back(std::move(line));
    }
    facts();
    return {{sheet_.name(), used_deg_, design_, std::move(lines_)}, std::move(springs_)};
  }

 private:
  void ask(const char* key, const std::string& what, const char* unit, Number wanted, Number found,
           Bound bound = Bound::at_least, const std::string& note = "") {
    lines_.push_back({key, what, unit, wanted, found, bound, note});
  }
  void tell(const char* key, const std::string& what, const char* unit, Number found,
            const std::string& note = "") {
    ask(key, what, unit, {}, found, Bound::at_least, note);
  }

  // The largest sample up to which the energy rises; by moments above a stop.
  void energy_falls_from() {
    const solver::Fill& fill = springs_.actuators.fill;
    if (schema::are_equal_springs(fill)) return;
    double from_deg = stop_deg();
    if (from_deg == 0) {
      from_deg = sheet_.sample_deg(
          solver::energy_history(sheet_, sheet_.history(), fill).deploys_from_sample);
    } else {
      for (std::size_t row = 1; row < springs_.pilot_deg.size(); ++row) {
        if (springs_.pilot_deg[row] <= stop_deg()) continue;
        if (!(springs_.moment_n_mm[row] > 0)) break;
        from_deg = springs_.pilot_deg[row];
      }
    }
    ask("energy_falls_from_deg", fmt::format("Deployment angle, energy of {} falls", parts()),
        "deg", used_deg_, from_deg);
  }

  // Nothing that is undecided passes.
  void deploys_from() {
    const bool is_decided = sheet_.verdict().first_fault != solver::Fault::undecided;
    const double d_deg = sheet_.deploys_from_deg();
    ask("deploys_from_deg",
        by_energy() ? "Deployment angle D, total energy falls"
                    : "Deployment angle D, every diagonal monotone",
        "deg", design_.from_deg.value_or(used_deg_), is_decided ? Number(d_deg) : std::nullopt,
        Bound::at_least,
        is_decided
            ? ""
            : fmt::format("undecided: the path is lost beyond {:.10g}° (a numerical failure)",
                          d_deg));
  }

  void geometry() {
    deploys_from();
    energy_falls_from();
    const auto [certified_deg, note] = certified();
    ask("certified_deg",
        by_energy() ? "Certified angle, by energy, proven between samples too"
                    : "Certified angle, proven between samples too",
        "deg", used_deg_, certified_deg, Bound::at_least, note);
    for (schema::CardLine& line : contact_lines(chosen_, sheet_, design_, used_deg_)) {
      lines_.push_back(std::move(line));
    }
  }

  bool by_energy() const { return chosen_.sampling.energy_of.has_value(); }

  std::pair<Number, std::string> certified() const {
    if (!sheet_.base().springs.in_mid_plane()) {
      return {{}, "no certificate exists for springs off the mid-plane"};
    }
    if (schema::is_overconstrained(sheet_.base())) {
      const auto proof = solver::prove_member(sheet_.base(), chosen_.shifts_mm, used_deg_);
      if (proof.holds()) return {proof.certified_deg, "proven in rational numbers"};
      return {{}, proof.gap.why(sheet_.base().sheet)};
    }
    RowCertifier certifier(chosen_.base, sheet_.model(),
                           claims_of(chosen_.base, chosen_.sampling, chosen_.design));
    const auto row = certifier.certify(0, chosen_.shifts_mm, used_deg_);
    return {row.certified_deg, ""};
  }

  void bent() {
    const auto [material, panels, advice, buckling, preload] =
        bent_sheet(sheet_, release_, design_);
    const std::string bend =
        fmt::format(", bending panels of {:g} mm {}", panels.thickness_mm, material.name);
    const double hinge_friction = release_.sheet.joints.friction_n_mm_per_mm;
    const solver::BentFriction& friction = panels.friction;
    if (stop_deg() == 0) {
      margin("energy_margin", "Energy margin over hinge friction" + bend,
             design_.energy_margin.value_or(solver::kWantedMargin), friction.critical_n_mm_per_mm,
             hinge_friction);
    }
    const Number least = friction.static_n_mm_per_mm;
    margin("static_margin",
           fmt::format("Static margin over hinge friction, down to {:g}°{}", panels.options.to_deg,
                       bend),
           design_.static_margin.value_or(solver::kWantedMargin), least, hinge_friction);
    if (stop_deg() == 0) {
      tell("bent_critical_friction_n_mm_per_mm", "Critical friction, bending panels", "N mm/mm",
           friction.critical_n_mm_per_mm);
    } else {
      stop();
    }
    // Plates have to drive the sheet: their pre-stretch may bend its panels instead.
    ask("static_friction_n_mm_per_mm",
        fmt::format("Static friction overcome, worst at {:.3g}°", friction.static_deg), "N mm/mm",
        design_.is_springs() ? Number{} : Number{0}, least, Bound::at_least,
        *least > 0 ? "" : "no moment drives the sheet towards flat there");
    const solver::BentAngle& most = panels.most_bent();
    ask("largest_stress_mpa",
        fmt::format("Largest static panel stress, farther than {:g} panel widths from corners",
                    solver::kCornerWidths),
        "MPa", material.strength_mpa, most.largest_stress_mpa, Bound::at_most);
    const solver::BucklingStudy::Least& pressed = buckling.least();
    if (pressed.kind != solver::BucklingKind::none) {
      tell("buckling_factor",
           fmt::format("Buckling factor of panels, least at {:.3g}° in {},{}", pressed.pilot_deg,
                       pressed.place[0], pressed.place[1]),
           "", pressed.factor, "an estimate");
    }
    tell("bent_energy_n_mm", "Stored energy", "N mm", panels.angles.back().bent.n_mm,
         fmt::format("rigid panels: {:.4g} N mm", panels.angles.back().rigid_n_mm));
    if (design_.is_springs()) {
      tell("useful_stiffness_n_per_mm",
           fmt::format("Spring rate for {:g} % of the attainable friction", 100 * solver::kUseful),
           "N/mm", advice.useful_stiffness_n_per_mm);
    }
    if (hinge_friction > 0) {
      tell("least_thickness_mm",
           fmt::format("Panel thickness for a static margin of {:g}", advice.wanted_margin), "mm",
           advice.least_thickness_mm, advice.least_thickness_mm ? "" : "none; see preload_n");
    }
    if (preload && preload->modes.unstable > 0) {
      tell("unstable_modes_at_flat", "Unstable modes at flat", "", {},
           fmt::format("{} of {} rigid-folding modes, by the preload; a stop, latch or frame must "
                       "hold the sheet",
                       preload->modes.unstable, preload->modes.rigid));
    }
  }

  // The angle at which the filling is relaxed: 0 for flat.
  double stop_deg() const { return design_.rest_deg.value_or(0); }
  const char* parts() const { return schema::fill_nouns(release_.sheet.fill).parts; }

  void stop() {
    const auto stiffness = solver::rest_stiffness(sheet_, release_, bending(design_).material);
    tell("rest_stiffness_n_mm_per_rad",
         fmt::format("Rotational stiffness at the stop, {:g}°, bending panels", stop_deg()),
         "N mm/rad", stiffness ? Number(stiffness->n_mm_per_rad) : std::nullopt,
         stiffness ? "" : "not known with a preload or pre-stretch");
  }

  // The angle of release: the last sample that its way reaches, if that is less.
  double release_deg() const {
    const solver::FoldingWay* const way = sheet_.way();
    const double sample_deg = chosen_.sampling.sample_deg;
    if (way == nullptr || used_deg_ < way->end_deg()) return used_deg_;
    return std::min(used_deg_, sample_deg * (std::ceil(way->end_deg() / sample_deg) - 1));
  }

  // Panels are bent by springs on the vertices alone.
  void rigid() {
    if (stop_deg() > 0) {
      tell("static_margin", "Static margin over hinge friction", "", {},
           "bending panels and a static margin need springs on the vertices");
      return;
    }
    const solver::StaticRelease study =
        value_or_throw(solver::static_release(sheet_, release_), sheet_.name(), "it has no card");
    margin("energy_margin", "Energy margin over hinge friction, rigid panels",
           design_.energy_margin.value_or(solver::kWantedMargin),
           study.friction.critical_n_mm_per_mm, release_.sheet.joints.friction_n_mm_per_mm);
    lines_.back().note = "bending panels and a static margin need springs on the vertices";
  }

  // Margin of the friction that is overcome over the design's; required where that is not 0.
  void margin(const char* key, const std::string& what, double wanted, Number overcome,
              double friction) {
    if (friction > 0) {
      ask(key, what, "", wanted, overcome ? *overcome / friction - 1 : -1);
    } else {
      tell(key, what, "", {}, "the design names no friction");
    }
  }

  void released() {
    if (!has("SUNDIALS")) {
      ask("landing_deg_per_s", "Landing speed, rigid panels", "deg/s", design_.landing_deg_per_s,
          {}, Bound::at_most, schema::missing_text("SUNDIALS"));
      return;
    }
    const solver::DeploymentStudy study = deployed(sheet_, release_);
    Number rate, energy;
    for (const solver::Deployment::Row& row : study.run.rows) {
      if (stop_deg() > 0 ? row.pilot_deg > stop_deg()
                         : row.event != solver::Deployment::Event::flat) {
        continue;
      }
      rate = std::abs(row.rate_deg_per_s);
      energy = row.kinetic_n_mm;
      break;
    }
    ask("landing_deg_per_s", "Landing speed, rigid panels", "deg/s", design_.landing_deg_per_s,
        rate, Bound::at_most,
        rate             ? ""
        : stop_deg() > 0 ? "the sheet does not reach its stop"
                         : "the sheet does not reach flat");
    tell("landing_energy_n_mm", "Landing energy, taken by a latch", "N mm", energy);
    tell("mass_g", "Panel mass", "g", study.mass_t * 1e6);
  }

  void pins() {
    const auto study = pins_of(sheet_, release_, design_);
    if (!study || stop_deg() > 0) return;
    const double pin_friction_mm = study->own_mm;
    for (const auto& [pins, key, where] :
         {std::tuple(&study->in_middle, "pin_margin_in_middle",
                     "a pin in the middle of each hinge"),
          std::tuple(&study->at_ends, "pin_margin_at_ends", "a pin at each end")}) {
      margin(key, fmt::format("Energy margin over pin friction, {}, rigid panels", where),
             design_.energy_margin.value_or(solver::kWantedMargin), pins->critical_mm,
             pin_friction_mm);
      if (const auto stall_deg = pins->stall_deg(pin_friction_mm)) {
        lines_.back().note = fmt::format("quasi-static motion locks at {:.3g}°", *stall_deg);
      }
    }
  }

  // Strokes and forces of springs; of plates the forces alone.
  void springs() {
    if (!design_.is_springs()) {
      if (!design_.is_plate()) return;
      tell("largest_force_n", "Largest force of a rubber plate along a diagonal", "N",
           springs_.largest_force_n(), "rigid panels");
      return;
    }
    const std::vector<double> strokes_mm = solver::strokes_mm(sheet_.history(), springs_.from_row);
    const std::size_t least = std::ranges::min_element(strokes_mm) - strokes_mm.begin();
    const std::size_t most = std::ranges::max_element(strokes_mm) - strokes_mm.begin();
    const auto label = [&](std::size_t d) {
      const solver::Diagonal& diagonal = sheet_.mechanism().diagonals[d];
      return solver::line_label(diagonal.from, diagonal.to);
    };
    ask("least_stroke_mm",
        design_.miscut_mm ? "Smallest spring stroke, to exceed the cutting error"
                          : "Smallest spring stroke, to exceed a usual cutting error",
        "mm", design_.miscut_mm.value_or(solver::kLeastStroke_mm), strokes_mm[least],
        Bound::at_least,
        fmt::format("smallest at {}, largest at {}: {:.4g} mm", label(least), label(most),
                    strokes_mm[most]));
    double stroke = 0;
    for (std::size_t d = 0; d < strokes_mm.size(); ++d) {
      stroke = std::max(stroke, strokes_mm[d] / sheet_.history().flat_mm[d]);
    }
    ask("stroke", "Largest spring elongation", "", design_.stroke_limit, stroke, Bound::at_most);
    ask("largest_force_n", "Largest spring force", "N", design_.largest_force_n,
        springs_.largest_force_n(), Bound::at_most, "rigid panels");
  }

  void facts() {
    const auto box = [](const Eigen::Vector3d& mm) {
      return fmt::format("{:.4g} x {:.4g} x {:.3g} mm", mm.x(), mm.y(), mm.z());
    };
    Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, sheet_.vertices_mm().cols());
    flat_mm.topRows<2>() = sheet_.vertices_mm();
    if (springs_.from_row > 0) {
      tell("stowed_mm", "Stowed size, without thickness", "", {},
           box(solver::least_box_mm(
               sheet_.shapes_mm()[static_cast<std::size_t>(springs_.from_row - 1)])) +
               "; flat " + box(solver::least_box_mm(flat_mm)));
    }
  }

  const ChosenSheet& chosen_;
  const solver::Sheet& sheet_;
  const schema::Design& design_;
  const CardOptions& options_;
  double used_deg_ = 0;
  solver::Actuation springs_;
  solver::ReleaseOptions release_;
  std::vector<CardLine> lines_;
};

}  // namespace

StudiedCard card_of(const Subject& subject, const CardOptions& options) {
  return CardMaker(subject, options).make();
}

}  // namespace misalign::search
