#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "schema/exchange/actuators_json.hpp"
#include "schema/exchange/spring_clearance_json.hpp"
#include "schema/exchange/spring_faces_json.hpp"
#include "schema/files/text_table.hpp"
#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

// Pairs that are listed; JSON has all.
constexpr std::size_t kMostPairs = 12;

std::string apart_text(const solver::ContactStudy& study) {
  const auto shown = [](double mm) {
    return std::isfinite(mm) ? fmt::format("{:.3f}", mm) : std::string("-");
  };
  std::vector<schema::Row> rows = {
      {"pilot_deg", "in_hole_mm", "largest_mm", "springs_mm", "panels_mm"}};
  for (std::size_t k = 0; k < study.pilot_deg.size(); ++k) {
    const bool is_last = k + 1 == study.pilot_deg.size();
    if (!is_last && std::abs(std::remainder(study.pilot_deg[k], 10)) > 1e-9) continue;
    const solver::SpringClearance::Apart& at = study.springs->apart[k];
    const bool has_holes = std::isfinite(at.least_hole_mm);
    rows.push_back({fmt::format("{:g}", study.pilot_deg[k]), shown(at.least_hole_mm),
                    has_holes ? shown(at.largest_hole_mm) : "-", shown(at.springs_mm),
                    shown(at.panels_mm)});
  }
  return "\n" + schema::aligned(rows, {true, true, true, true, true});
}

}  // namespace

std::string spring_clearance_text(const schema::Pattern& base, const solver::Panels& panels,
                                  const solver::ContactStudy& study) {
  if (!study.springs) return "";
  const solver::SpringClearance& clearance = *study.springs;
  std::string text = fmt::format(
      "\nsprings        {:g} mm thick without {:g} mm at each end, panels {:g} mm\n",
      clearance.bodies.diameter_mm, clearance.bodies.left_out_mm(), clearance.bodies.panel_mm);
  const auto add = [&](const solver::SpringMeeting& met) {
    text += fmt::format("{:<15}{}: {:.3f} mm at {:.4g} deg\n", met.touches() ? "touch" : "closest",
                        schema::meeting_text(base, panels, clearance.diagonals, met), met.clear_mm,
                        met.pilot_deg);
  };
  for (const solver::SpringMeetings* meetings : {&clearance.springs, &clearance.panels}) {
    const auto& touching = meetings->touching;
    if (touching.empty() && meetings->closest) add(*meetings->closest);
    for (std::size_t k = 0; k < std::min(touching.size(), kMostPairs); ++k) add(touching[k]);
    if (touching.size() > kMostPairs) {
      text += fmt::format("{:<15}and {} more pairs (--json)\n", "", touching.size() - kMostPairs);
    }
  }
  return text + apart_text(study);
}

std::string spring_clearance_note(const schema::Pattern& base, const solver::Panels& panels,
                                  const solver::SpringClearance& clearance) {
  const solver::SpringMeeting& met = *closest_meeting(clearance);
  return fmt::format("{} at {:.3g}°; {} pairs of springs touch, and {} of springs and panels",
                     schema::meeting_text(base, panels, clearance.diagonals, met), met.pilot_deg,
                     clearance.springs.touching.size(), clearance.panels.touching.size());
}

std::string spring_faces_text(const solver::SpringFaces& faces) {
  return fmt::format("\n{}\n", fmt::join(schema::faces_sentences(faces), "\n"));
}

std::string spring_faces_table(const solver::Mechanism& mechanism,
                               const solver::SpringFaces& faces) {
  if (faces.springs.empty()) return "";
  std::vector<schema::Row> rows = {{"diagonal", "turn", "face", "axis"}};
  for (const solver::HungSpring& hung : faces.springs) {
    rows.push_back({schema::diagonal_label(mechanism, hung.diagonal), std::to_string(hung.turn + 1),
                    schema::word_of(hung.face), schema::height_words(hung)});
  }
  return "\n" + schema::aligned(rows, {false, true, false, false});
}

}  // namespace misalign::search
