#include "schema/kit/kit_springs_way.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "schema/exchange/spring_faces_json.hpp"
#include "schema/kit/page_parts.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::schema {
namespace {

std::string hook_words(const solver::Sheet& sheet, const KitFittings& fittings, int spring,
                       int vertex) {
  const std::string at = solver::vertex_label(vertex);
  if (const SpringTab* const tab = fittings.tab_at(vertex)) {
    return fmt::format("{}: tab of {}", at, panel_label(sheet, tab->facet));
  }
  const auto is_its_bore = [&](const Bore& bore) {
    return bore.spring == spring && bore.vertex == vertex;
  };
  const auto bore = std::ranges::find_if(fittings.bores, is_its_bore);
  if (bore != fittings.bores.end()) {
    return fmt::format("{}: bore of {}", at, panel_label(sheet, bore->facet));
  }
  const bool is_ball =
      std::ranges::any_of(sheet.mechanism().balls,
                          [&](const solver::BallJoint& ball) { return ball.vertex == vertex; });
  return at + (is_ball ? ": loop of the ball joint" : ": bore at the vertex");
}

std::string rows_of(const solver::Sheet& sheet, const KitFittings& fittings,
                    const solver::SpringFaces& faces) {
  std::vector<solver::HungSpring> order = faces.springs;
  std::ranges::sort(order, {}, &solver::HungSpring::turn);
  std::string text;
  for (const solver::HungSpring& spring : order) {
    const solver::Diagonal& diagonal =
        sheet.mechanism().diagonals[static_cast<std::size_t>(spring.diagonal)];
    text += table_row({std::to_string(spring.turn + 1), "s" + std::to_string(spring.diagonal),
                       word_of(spring.face), height_words(spring),
                       hook_words(sheet, fittings, spring.diagonal, diagonal.from),
                       hook_words(sheet, fittings, spring.diagonal, diagonal.to)},
                      6);
  }
  return text;
}

// Springs that are shorter than free at every angle up to that of use.
std::vector<std::string> pushing_springs(const solver::Sheet& sheet,
                                         const solver::SpringFaces& faces) {
  const solver::FoldingWay& way = *sheet.way();
  const solver::Filling filling = filling_on(way, faces.bodies.fill);
  constexpr int kSteps = 90;
  Eigen::VectorXd most_mm = way.flat_mm(), length_mm, slope_mm;
  for (int step = 1; step <= kSteps; ++step) {
    way.find_lengths(way.x_of(faces.to_deg) * step / kSteps, length_mm, slope_mm);
    most_mm = most_mm.cwiseMax(length_mm);
  }
  std::vector<std::string> pushing;
  for (const solver::HungSpring& spring : faces.springs) {
    if (most_mm(spring.diagonal) < filling.relaxed_mm()(spring.diagonal)) {
      pushing.push_back("s" + std::to_string(spring.diagonal));
    }
  }
  return pushing;
}

std::string sentences_of(const solver::Sheet& sheet, const solver::SpringFaces& faces) {
  std::string text = fmt::format("<p>{}", fmt::join(faces_sentences(faces), " "));
  if (faces.springs.empty()) return text + "</p>\n";
  text +=
      " Hooks hang in from the face that the table names, at both ends. Hang the springs below "
      "first, then turn the sheet over.";
  const std::vector<std::string> pushing = pushing_springs(sheet, faces);
  if (!pushing.empty()) {
    text += fmt::format(
        " {} push: give each a guide, a rod inside or a tube outside, that ends "
        "free of both vertices when the spring is shortest.",
        fmt::join(pushing, ", "));
  }
  return text + "</p>\n";
}

}  // namespace

std::string springs_way_section(const solver::Sheet& sheet, const Design& design,
                                const KitFittings& fittings, double from_deg) {
  if (!design.is_springs()) return "";
  const auto faces = solver::spring_faces(sheet, design.spring_bodies(), from_deg);
  if (!faces) return "";
  std::string text = "<h2>Way of the springs</h2>\n" + sentences_of(sheet, *faces);
  if (faces->springs.empty()) return text;
  return text + table_begin({"order", "spring", "face", "axis", "first hook", "second hook"}, 6) +
         rows_of(sheet, fittings, *faces) + kTableEnd;
}

}  // namespace misalign::schema
