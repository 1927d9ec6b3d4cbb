#include "search/sheets/card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/files/features.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "search/sheets/backlash.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/tolerance.hpp"
#include "solver/certificate/member_proof.hpp"
#include "solver/contact/least_box.hpp"
#include "solver/records/strokes.hpp"

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
                                  ": deploys from nothing (its D is 0), so that it has no card; "
                                  "`misalign fold` says what is in the way");
    }
    used_deg_ = std::min(design_.from_deg.value_or(d_deg), d_deg);
    springs_ = solver::actuate(sheet_, design_.actuators(),
                               used_deg_ < d_deg ? Number(used_deg_) : std::nullopt);
    release_ = deploy_options(design_, sheet_);
    release_.from_deg = release_deg();
  }

  StudiedCard make() {
    geometry();
    sheet_.base().springs.at_vertices() ? bent() : rigid();
    released();
    pins();
    springs();
    copies();
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

  // Nothing that is undecided passes.
  void deploys_from() {
    const bool is_decided = sheet_.verdict().first_fault != solver::Fault::undecided;
    const double d_deg = sheet_.deploys_from_deg();
    ask("deploys_from_deg", "every diagonal goes one way, up to", "deg",
        design_.from_deg.value_or(used_deg_), is_decided ? Number(d_deg) : std::nullopt,
        Bound::at_least,
        is_decided
            ? ""
            : fmt::format("undecided: beyond {:.10g} deg its path is lost (a numerical failure)",
                          d_deg));
  }

  void geometry() {
    deploys_from();
    const auto [certified_deg, note] = certified();
    ask("certified_deg", "the same, proven for every angle", "deg", used_deg_, certified_deg,
        Bound::at_least, note);
    const solver::ContactStudy contact = contact_of(sheet_, {{}, used_deg_});
    ask("first_contact_deg", "panels do not meet, up to", "deg", used_deg_,
        contact.first ? contact.first->pilot_deg : contact.known_until_deg);
    const bool is_reached = contact.reach_deg >= contact.used_from_deg;
    const Number thickness_mm =
        contact.thickness ? Number(is_reached ? contact.thickness->thickness_mm : 0) : std::nullopt;
    ask("thickness_mm",
        fmt::format("plates may be as thick, tapered, corners trimmed by {:g} mm", contact.trim_mm),
        "mm", design_.thickness_mm, thickness_mm);
  }

  std::pair<Number, std::string> certified() const {
    if (!sheet_.base().springs.in_mid_plane()) {
      return {{}, "springs off the mid-plane have no proof"};
    }
    if (schema::is_overconstrained(sheet_.base())) {
      const auto proof = solver::prove_member(sheet_.base(), chosen_.shifts_mm, used_deg_);
      if (proof.holds()) return {proof.certified_deg, "in rational numbers"};
      return {{}, proof.gap.why(sheet_.base().sheet)};
    }
    RowCertifier certifier(chosen_.base, sheet_.model());
    const auto row = certifier.certify(0, chosen_.shifts_mm, used_deg_);
    return {row.certified_deg, ""};
  }

  void bent() {
    const auto [material, panels, advice, preload] = bent_sheet(sheet_, release_, design_);
    const std::string bend =
        fmt::format(", panels of {:g} mm {} bending", panels.thickness_mm, material.name);
    const double own = release_.sheet.joints.friction_n_mm_per_mm;
    const solver::BentFriction& friction = panels.friction;
    margin("energy_margin", "energy margin over the hinges' friction" + bend,
           design_.energy_margin.value_or(solver::kWantedMargin), friction.critical_n_mm_per_mm,
           own);
    const Number least = friction.static_n_mm_per_mm;
    margin("static_margin",
           fmt::format("static margin over it at every angle down to {:g} deg{}",
                       panels.options.to_deg, bend),
           design_.static_margin.value_or(solver::kWantedMargin), least, own);
    tell("bent_critical_friction_n_mm_per_mm", "let go, it gets to flat with friction up to",
         "N mm per mm", friction.critical_n_mm_per_mm);
    tell("static_friction_n_mm_per_mm",
         fmt::format("moving slowly, least at {:.3g} deg, with", friction.static_deg),
         "N mm per mm", least, *least > 0 ? "" : "there nothing drives it on to flat");
    const solver::BentAngle& most = panels.most_bent();
    ask("largest_stress_mpa",
        fmt::format(
            "largest stress in the panels, held, farther than {:g} of their width from corners",
            solver::kCornerWidths),
        "MPa", material.strength_mpa, most.largest_stress_mpa, Bound::at_most);
    tell("bent_energy_n_mm", "springs and panels hold", "N mm", panels.angles.back().bent.n_mm,
         fmt::format("rigid: {:.4g} N mm", panels.angles.back().rigid_n_mm));
    tell("useful_stiffness_n_per_mm",
         fmt::format("{:g} % of what the stiffest springs overcome, from", 100 * solver::kUseful),
         "N/mm", advice.useful_stiffness_n_per_mm);
    if (own > 0) {
      tell("least_thickness_mm",
           fmt::format("a static margin of {:g}, of panels from", advice.wanted_margin), "mm",
           advice.least_thickness_mm, advice.least_thickness_mm ? "" : "none is thick enough");
    }
    if (preload && preload->modes.unstable > 0) {
      tell("unstable_modes_at_flat", "flat is not held by the preload", "", {},
           fmt::format(
               "{} of {} ways to leave flat are pushed on: a stop, a latch or a frame holds it",
               preload->modes.unstable, preload->modes.rigid));
    }
  }

  // Where it is let go: at the last sample that its way reaches, if that is less.
  double release_deg() const {
    const solver::FoldingWay* const way = sheet_.way();
    const double sample_deg = chosen_.sampling.sample_deg;
    if (way == nullptr || used_deg_ < way->end_deg()) return used_deg_;
    return std::min(used_deg_, sample_deg * (std::ceil(way->end_deg() / sample_deg) - 1));
  }

  // Panels are bent by springs on the vertices alone.
  void rigid() {
    const solver::StaticRelease study =
        value_or_throw(solver::static_release(sheet_, release_), sheet_.name(), "it has no card");
    margin("energy_margin", "energy margin over the hinges' friction, panels rigid",
           design_.energy_margin.value_or(solver::kWantedMargin),
           study.friction.critical_n_mm_per_mm, release_.sheet.joints.friction_n_mm_per_mm);
    lines_.back().note = "panels that bend, and a static margin, are of springs on the vertices";
  }

  // Of something that resists with `own`: asked only where there is some.
  void margin(const char* key, const std::string& what, double wanted, Number most, double own) {
    if (own > 0) {
      ask(key, what, "", wanted, most ? *most / own - 1 : -1);
    } else {
      tell(key, what, "", {}, "no friction is named");
    }
  }

  void released() {
    if (!has("SUNDIALS")) {
      ask("landing_deg_per_s", "lands no faster than", "deg/s", design_.landing_deg_per_s, {},
          Bound::at_most, schema::missing_text("SUNDIALS"));
      return;
    }
    const solver::DeploymentStudy study = deployed(sheet_, release_);
    Number rate, energy;
    for (const solver::Deployment::Row& row : study.run.rows) {
      if (row.event != solver::Deployment::Event::flat) continue;
      rate = std::abs(row.rate_deg_per_s);
      energy = row.kinetic_n_mm;
      break;
    }
    ask("landing_deg_per_s", "lands with, panels rigid", "deg/s", design_.landing_deg_per_s, rate,
        Bound::at_most, rate ? "" : "it does not get to flat");
    tell("landing_energy_n_mm", "which a latch must take", "N mm", energy);
    tell("mass_g", "panels weigh", "g", study.mass_t * 1e6);
  }

  void pins() {
    const auto study = pins_of(sheet_, release_, design_);
    if (!study) return;
    const double own = study->own_mm;
    for (const auto& [pins, key, where] :
         {std::tuple(&study->in_middle, "pin_margin_in_middle", "one in the middle of each hinge"),
          std::tuple(&study->at_ends, "pin_margin_at_ends", "one at each end")}) {
      margin(key, fmt::format("energy margin over pins' friction, {}, panels rigid", where),
             design_.energy_margin.value_or(solver::kWantedMargin), pins->critical_mm, own);
      if (const auto stall_deg = pins->stall_deg(own)) {
        lines_.back().note = fmt::format("moving slowly it locks at {:.3g} deg", *stall_deg);
      }
    }
  }

  void springs() {
    const std::vector<double> strokes_mm = solver::strokes_mm(sheet_.history(), springs_.from_row);
    const std::size_t least = std::ranges::min_element(strokes_mm) - strokes_mm.begin();
    const std::size_t most = std::ranges::max_element(strokes_mm) - strokes_mm.begin();
    const auto label = [&](std::size_t d) {
      const solver::Diagonal& diagonal = sheet_.mechanism().diagonals[d];
      return solver::line_label(diagonal.from, diagonal.to);
    };
    ask("least_stroke_mm",
        design_.miscut_mm ? "every spring moves by what cutting is off by, or more"
                          : "every spring moves by what can be cut, or more",
        "mm", design_.miscut_mm.value_or(solver::kLeastStroke_mm), strokes_mm[least],
        Bound::at_least,
        fmt::format("{} by the least, {} by the most: {:.4g} mm", label(least), label(most),
                    strokes_mm[most]));
    double stroke = 0;
    for (std::size_t d = 0; d < strokes_mm.size(); ++d) {
      stroke = std::max(stroke, strokes_mm[d] / sheet_.history().flat_mm[d]);
    }
    ask("stroke", "springs become longer or shorter by a share of", "", design_.stroke_limit,
        stroke, Bound::at_most);
    ask("largest_force_n", "a spring pulls or pushes with", "N", design_.largest_force_n,
        springs_.largest_force_n(), Bound::at_most, "panels rigid");
  }

  // The first sample from the angle of use on: copies are judged at samples.
  double sample_of_use_deg() const {
    const double sample_deg = chosen_.sampling.sample_deg;
    return std::ceil(used_deg_ / sample_deg - 1e-9) * sample_deg;
  }

  void copies() {
    const schema::Campaign campaign =
        chosen_.drawn ? chosen_.drawn->campaign : chosen_.as_campaign();
    const std::vector<Eigen::Matrix2Xd> shifts_mm = {chosen_.shifts_mm};
    const bool is_overconstrained = schema::is_overconstrained(sheet_.base());
    const Number& miscut_mm = design_.miscut_mm;
    if (miscut_mm && is_overconstrained) {
      ask("yield", "of miscut copies deploy, a share of", "",
          design_.yield.value_or(solver::kWantedShare), 0, Bound::at_least,
          "no miscut copy with so few holes folds; misalign tolerance says how far joints open");
    } else if (miscut_mm) {
      check_miscut(*miscut_mm, sheet_.base().sheet, chosen_.shifts_mm, sheet_.name());
      ToleranceOptions study;
      study.amplitude_mm = *miscut_mm;
      study.trials = options_.trials;
      study.jobs = options_.jobs;
      study.set = solver::available_instruction_sets().back();
      const schema::Campaign used = used_from(campaign, sample_of_use_deg(), shifts_mm, study,
                                              [&](std::size_t) { return sheet_.name(); });
      const solver::Tolerance tolerance = study_tolerance(used, shifts_mm, study).front();
      const double survivors = static_cast<double>(tolerance.survivors());
      ask("yield", fmt::format("of copies miscut by {:g} mm deploy, a share of", *miscut_mm), "",
          design_.yield.value_or(solver::kWantedShare),
          survivors / static_cast<double>(std::max<std::uint64_t>(1, tolerance.copies.decided())));
    }
    if (!design_.play_mm) return;
    if (is_overconstrained) {
      ask("play_mm", "joints may be loose by", "mm", design_.play_mm, {}, Bound::at_least,
          "with so few holes no joint may be loose");
      return;
    }
    const BacklashStudy study(campaign, shifts_mm, {});
    const auto loose = study.run({*design_.play_mm, options_.trials, options_.jobs}).front();
    ask("play_mm", fmt::format("joints may be loose by, from {:g} deg to its D", loose.from_deg),
        "mm", design_.play_mm, loose.largest_mm);
  }

  void facts() {
    const auto box = [](const Eigen::Vector3d& mm) {
      return fmt::format("{:.4g} x {:.4g} x {:.3g} mm", mm.x(), mm.y(), mm.z());
    };
    Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, sheet_.vertices_mm().cols());
    flat_mm.topRows<2>() = sheet_.vertices_mm();
    if (springs_.from_row > 0) {
      tell("stowed_mm", "stowed, without thickness", "", {},
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
