#include <fmt/format.h>

#include <algorithm>

#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

using solver::StressStudy;

std::string stress_line(const std::string& where, const schema::SimulatedSheet& sheet,
                        const std::optional<solver::StressHistory::Peak>& at) {
  if (!at) return fmt::format("  {}: no node lies there; take a finer --mesh\n", where);
  const auto [row, column] = sheet.places[static_cast<std::size_t>(at->panel)];
  return fmt::format(
      "  {}: {:.3g} MPa after {:.4f} s, in panel [{}, {}] at ({:.1f}, {:.1f}) mm of the flat "
      "sheet\n",
      where, at->stress_mpa, at->time_s, row, column, at->flat_mm.x(), at->flat_mm.y());
}

std::string stress_summary(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                           const solver::StressStudy& study) {
  const StressStudy::Row& last = study.rows.back();
  const schema::Material& material = options.deck.material;
  std::string text = fmt::format(
      "{:g} deg, {} x {} elements a panel of {} ({:g} GPa, {:g} mm), springs of {:g} N/mm\n",
      sheet.pilot_deg, options.deck.elements, options.deck.elements,
      schema::printable(material.name), material.e_gpa, sheet.plates.thickness_mm,
      sheet.stiffness_n_per_mm);
  if (study.deployed_s) {
    text += fmt::format("deployed: every crease within {:g} deg after {:.4f} s\n", options.flat_deg,
                        *study.deployed_s);
  } else {
    const std::string where =
        sheet.rest_deg > 0
            ? fmt::format(
                  "springs are relaxed at {:g} deg: after {:.4f} s the pilot is at {:.3f} deg",
                  sheet.rest_deg, last.time_s, last.pilot_deg)
            : fmt::format("not deployed: after {:.4f} s creases are within {:.2f} deg", last.time_s,
                          last.widest_deg);
    text += fmt::format("{}{}\n", where,
                        study.was_stopped ? "; stopped there"
                        : study.gave_up   ? "; ccx gave up there"
                                          : "");
  }
  text += "largest von Mises stress\n";
  text += stress_line(
      fmt::format("outside discs of {:g} mm round every vertex", options.stress.disc_mm), sheet,
      study.stress.outside);
  text += stress_line("anywhere, unbounded as meshes get finer", sheet, study.stress.anywhere);
  return text + fmt::format("CalculiX: {} increments, {:.0f} CPU s, {:.0f} MB\n",
                            study.rows.size() - 1, study.cpu_s, study.memory_mb);
}

// Shows at most twenty rows, the last among them; stresses are the largest since the row before.
std::string motion_table(const solver::StressStudy& study) {
  std::string text =
      "\n   time_s pilot_deg rigid_deg widest_deg springs_n_mm bending_n_mm kinetic_n_mm "
      "outside_discs_mpa\n";
  constexpr std::size_t kRows = 20;
  const std::size_t count = study.rows.size(), every = (count + kRows - 1) / kRows;
  std::size_t frame = 0;
  for (std::size_t k = (count - 1) % every; k < count; k += every) {
    const StressStudy::Row& row = study.rows[k];
    double largest_mpa = 0;
    for (; frame < study.stress.time_s.size() &&
           study.stress.time_s[frame] <= row.time_s * (1 + 1e-5);
         ++frame) {
      largest_mpa = std::max(largest_mpa, study.stress.outside_mpa[frame]);
    }
    const std::optional<double> rigid_deg = study.rigid_pilot_deg(row.time_s);
    text += fmt::format(
        "{:>9.5f} {:>9.3f} {:>9} {:>10.3f} {:>12.5g} {:>12.5g} {:>12.5g} {:>17.4g}\n", row.time_s,
        row.pilot_deg, rigid_deg ? fmt::format("{:.3f}", *rigid_deg) : "-", row.widest_deg,
        row.springs_n_mm, row.strain_n_mm, row.kinetic_n_mm, largest_mpa);
  }
  return text;
}

}  // namespace

std::string stress_text(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                        const solver::StressStudy& study) {
  return stress_summary(sheet, options, study) + motion_table(study);
}

}  // namespace misalign::search
