#include <fmt/format.h>

#include "schema/exchange/rubber_json.hpp"
#include "schema/pattern/fill_words.hpp"
#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

using solver::PlateState;
using solver::PlateWay;
using solver::Tension;

// The folded states of a plate in words: "wrinkled from 1 to 90 deg".
std::string tension_words(const std::vector<double>& pilot_deg, const PlateWay& plate) {
  std::string words;
  for (const auto& [tension, name] :
       {std::pair(Tension::wrinkled, "wrinkled"), std::pair(Tension::slack, "slack")}) {
    std::vector<double> at_deg;
    for (std::size_t row = 1; row < plate.states.size(); ++row) {
      if (plate.states[row].stretches.tension == tension) at_deg.push_back(pilot_deg[row]);
    }
    if (at_deg.empty()) continue;
    words += words.empty() ? "" : ", ";
    words += at_deg.size() + 1 == plate.states.size()
                 ? fmt::format("{} everywhere", name)
                 : fmt::format("{} at {} of {} angles, from {:g} to {:g} deg", name, at_deg.size(),
                               plate.states.size() - 1, at_deg.front(), at_deg.back());
  }
  return words.empty() ? "tense everywhere" : words;
}

std::string hole_words(const solver::Sheet& sheet, int facet) {
  const auto& [row, column] = sheet.base().sheet.places[static_cast<std::size_t>(facet)];
  return fmt::format("[{}, {}]", row, column);
}

}  // namespace

std::string rubber_text(const solver::Sheet& sheet, const solver::RubberStudy& study) {
  const solver::RubberPlates& plates = study.options.plates;
  std::string text = fmt::format(
      "{}, {};\nunstretched, each is worth springs of {:.3g} N/mm on both diagonals. Creep and the "
      "rate\nof stretching are left out.\n",
      schema::fill_words(plates, sheet.mechanism().diagonal_count()), schema::state_words(plates),
      study.equivalent_n_per_mm);
  text += "\n    hole  stretch at_deg  edges, N/mm at_deg  state of the folded plate\n";
  for (const PlateWay& plate : study.plates) {
    text +=
        fmt::format("{:>8} {:>8.4f} {:>5g}  {:>12.4g} {:>6g}  {}\n", hole_words(sheet, plate.facet),
                    plate.stretch.value, plate.stretch.pilot_deg, plate.edge_n_per_mm.value,
                    plate.edge_n_per_mm.pilot_deg, tension_words(study.pilot_deg, plate));
  }
  return text;
}

std::string cut_outs_text(const solver::Sheet& sheet, const solver::CutOutChoice& choice) {
  std::string text = fmt::format(
      "cut-outs chosen by hole: the slope of the energy by the square of the pilot angle is at\n"
      "least {:.4g} N mm/rad^2, at {:g} deg\n    hole  diagonals of the cut-out, to the flat "
      "hole's\n",
      choice.least_n_mm_per_rad2, choice.at_deg);
  for (const solver::CutOut& cut_out : choice.plates.cut_outs) {
    const auto d = static_cast<std::size_t>(2 * cut_out.hole);
    const auto loop = static_cast<std::size_t>(sheet.mechanism().diagonals[d].loop);
    text +=
        fmt::format("{:>8}  {:.4f} {:.4f}\n", hole_words(sheet, sheet.mechanism().loops[loop].hole),
                    cut_out.of_flat[0], cut_out.of_flat[1]);
  }
  return text + "\n";
}

}  // namespace misalign::search
