#include "search/sheets/card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "schema/pattern/fill_words.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "search/sheets/card_contact.hpp"
#include "search/sheets/card_copies.hpp"
#include "search/sheets/card_drive.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/studies.hpp"
#include "solver/certificate/member_proof.hpp"
#include "solver/contact/least_box.hpp"
#include "solver/records/strokes.hpp"
#include "solver/sheet/energy_history.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {
namespace {

using schema::CardLine;
using Number = std::optional<double>;

std::pair<Number, std::string> certified(const CardSheet& on) {
  const solver::PerforatedSheet& base = on.sheet.base();
  if (!base.springs.in_mid_plane()) {
    return {{}, "no certificate exists for springs off the mid-plane"};
  }
  const ChosenSheet& chosen = on.chosen;
  if (schema::is_overconstrained(base)) {
    const auto proof = solver::prove_member(base, chosen.shifts_mm, on.used_deg);
    if (proof.holds()) return {proof.certified_deg, "proven in rational numbers"};
    return {{}, proof.gap.why(base.sheet)};
  }
  RowCertifier certifier(chosen.base, on.sheet.model(),
                         claims_of(chosen.base, chosen.sampling, chosen.design));
  return {certifier.certify(0, chosen.shifts_mm, on.used_deg).certified_deg, ""};
}

// Nothing that is undecided passes.
std::vector<CardLine> path_lines(const CardSheet& on) {
  CardLines lines;
  const bool is_decided = on.sheet.verdict().first_fault != solver::Fault::undecided,
             is_by_energy = on.chosen.sampling.energy_of.has_value();
  const double d_deg = on.sheet.deploys_from_deg();
  lines.ask("deploys_from_deg",
            is_by_energy ? "Deployment angle D, total energy falls"
                         : "Deployment angle D, every diagonal monotone",
            "deg", on.design.from_deg.value_or(on.used_deg),
            is_decided ? Number(d_deg) : std::nullopt, CardLine::Bound::at_least,
            is_decided
                ? ""
                : fmt::format("undecided: the path is lost beyond {:.10g}° (a numerical failure)",
                              d_deg));
  const auto [certified_deg, note] = certified(on);
  lines.ask("certified_deg",
            is_by_energy ? "Certified angle, by energy, proven between samples too"
                         : "Certified angle, proven between samples too",
            "deg", on.used_deg, certified_deg, CardLine::Bound::at_least, note);
  return lines.take();
}

// The angle of use of a filling; none: D.
Number given_deg(const CardSheet& on) {
  return on.used_deg < on.sheet.deploys_from_deg() ? Number(on.used_deg) : std::nullopt;
}

// The lines of a filling along the diagonals.
class FillingLines : private CardLines {
 public:
  explicit FillingLines(const CardSheet& on)
      : on_(on),
        filling_(solver::actuate(on.sheet, on.design.actuators(on.sheet.base()), given_deg(on))) {}

  // The largest sample up to which the energy rises; by moments above a stop.
  std::vector<CardLine> energy() {
    const solver::Fill& fill = filling_.actuators.fill;
    if (schema::are_equal_springs(fill)) return {};
    double from_deg = on_.stop_deg();
    if (from_deg == 0) {
      from_deg = on_.sheet.sample_deg(
          solver::energy_history(on_.sheet, on_.sheet.history(), fill).deploys_from_sample);
    } else {
      for (std::size_t row = 1; row < filling_.pilot_deg.size(); ++row) {
        if (filling_.pilot_deg[row] <= on_.stop_deg()) continue;
        if (!(filling_.moment_n_mm[row] > 0)) break;
        from_deg = filling_.pilot_deg[row];
      }
    }
    ask("energy_falls_from_deg",
        fmt::format("Deployment angle, energy of {} falls", schema::fill_nouns(fill).parts), "deg",
        on_.used_deg, from_deg);
    return take();
  }

  // Strokes and forces of springs; of plates the forces alone.
  std::vector<CardLine> strokes_and_forces() {
    if (on_.design.is_springs()) {
      strokes();
      ask("largest_force_n", "Largest spring force", "N", on_.design.largest_force_n,
          filling_.largest_force_n(), Bound::at_most, "rigid panels");
    } else if (on_.design.is_plate()) {
      tell("largest_force_n", "Largest force of a rubber plate along a diagonal", "N",
           filling_.largest_force_n(), "rigid panels");
    }
    sizes();
    return take();
  }

 private:
  void sizes() {
    const auto box = [](const Eigen::Vector3d& mm) {
      return fmt::format("{:.4g} x {:.4g} x {:.3g} mm", mm.x(), mm.y(), mm.z());
    };
    Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, on_.sheet.vertices_mm().cols());
    flat_mm.topRows<2>() = on_.sheet.vertices_mm();
    if (filling_.from_row > 0) {
      const auto row = static_cast<std::size_t>(filling_.from_row - 1);
      tell("stowed_mm", "Stowed size, without thickness", "", {},
           box(solver::least_box_mm(on_.sheet.shapes_mm()[row])) + "; flat " +
               box(solver::least_box_mm(flat_mm)));
    }
  }

  void strokes() {
    const solver::FoldingHistory& history = on_.sheet.history();
    const std::vector<double> strokes_mm = solver::strokes_mm(history, filling_.from_row);
    const auto least = static_cast<std::size_t>(std::ranges::min_element(strokes_mm) -
                                                strokes_mm.begin()),
               most = static_cast<std::size_t>(std::ranges::max_element(strokes_mm) -
                                               strokes_mm.begin());
    const auto label = [&](std::size_t d) {
      const solver::Diagonal& diagonal = on_.sheet.mechanism().diagonals[d];
      return solver::line_label(diagonal.from, diagonal.to);
    };
    ask("least_stroke_mm",
        on_.design.miscut_mm ? "Smallest spring stroke, to exceed the cutting error"
                             : "Smallest spring stroke, to exceed a usual cutting error",
        "mm", on_.design.miscut_mm.value_or(solver::kLeastStroke_mm), strokes_mm[least],
        Bound::at_least,
        fmt::format("smallest at {}, largest at {}: {:.4g} mm", label(least), label(most),
                    strokes_mm[most]));
    ask("stroke", "Largest spring elongation", "", on_.design.stroke_limit,
        solver::largest_stroke(history, filling_.from_row), Bound::at_most);
  }

  const CardSheet& on_;
  const solver::Actuation filling_;
};

}  // namespace

std::vector<CardLine> card_lines(CardPart part, const CardSheet& on, const CardOptions& options) {
  switch (part) {
    case CardPart::path:
      return path_lines(on);
    case CardPart::energy:
      return FillingLines(on).energy();
    case CardPart::contact:
      return contact_lines(on);
    case CardPart::drive:
      return drive_lines(on, options.advice);
    case CardPart::filling:
      return FillingLines(on).strokes_and_forces();
    case CardPart::copies:
      break;
  }
  return copy_lines(on, {options.trials, options.jobs});
}

solver::Actuation filling_in_use(const CardSheet& on) {
  const Number from_deg = given_deg(on);
  return solver::actuate(on.sheet, actuators_on(on.sheet, on.design, from_deg), from_deg);
}

CardSheet card_sheet(const Subject& subject) {
  const solver::Sheet& sheet = subject.sheet;
  if (sheet.deploys_from_deg() <= 0) {
    throw schema::UserError(schema::Cause::bad_input,
                            sheet.name() +
                                ": the sheet does not deploy (D = 0), so it has no card; "
                                "`misalign fold` shows its first fault");
  }
  const schema::Design& design = subject.model.design();
  return {subject.chosen, sheet, design, solver::angle_of_use(sheet, design.from_deg)};
}

StudiedCard card_of(const CardSheet& on, const CardOptions& options, CardParts same) {
  need_energy(on.sheet, on.design.fill(on.sheet.base()), "it has no card");
  StudiedCard made{{on.sheet.name(), on.used_deg, on.design, {}, {}}, std::move(same)};
  for (std::size_t part = 0; part < kCardParts; ++part) {
    std::vector<CardLine>& lines = made.parts[part];
    if (lines.empty()) lines = card_lines(static_cast<CardPart>(part), on, options);
    std::ranges::copy(lines, std::back_inserter(made.card.lines));
  }
  return made;
}

StudiedCard card_of(const Subject& subject, const CardOptions& options) {
  return card_of(card_sheet(subject), options);
}

}  // namespace misalign::search
