#include "schema/kit/kit_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "schema/exchange/xml_text.hpp"
#include "schema/kit/joint_words.hpp"
#include "schema/kit/page_parts.hpp"
#include "schema/kit/sheet_pictures.hpp"
#include "schema/pattern/fill_words.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;

class Steps {
 public:
  explicit Steps(const GuideInput& input) : input_(input), sheet_(input.sheet) {}

  std::string text() const {
    return "<h2>Assembly</h2>\n<ol class=\"steps\">\n" + trial() + rows() + joints() + folding() +
           filling() + "</ol>\n";
  }

 private:
  std::string trial() const {
    const bool has_springs = std::holds_alternative<solver::Springs>(input_.fill());
    return fmt::format(
        "<li><b>Try first.</b> {} {} a few times, join the third square to the corner{}. Then set "
        "kerf and bores.</li>\n",
        input_.options.test_piece ? "Cut the test piece, which has a file of its own."
                                  : "Cut one hinge and one ball joint of the material.",
        are_apart(input_.options.crease) ? "Hinge its squares and fold them" : "Fold its crease",
        has_springs ? ", and hang one spring between the tab and the joint" : "");
  }

  // The row of a panel in the sheet.
  int row_of(int facet) const {
    return sheet_.base().sheet.places[static_cast<std::size_t>(facet)][0];
  }

  // The sheets of material on which panels of a row lie.
  std::string lying_on(int row) const {
    std::set<std::size_t> beds;
    for (std::size_t k = 0; k < input_.kit.parts.size(); ++k) {
      for (const int facet : input_.kit.parts[k].facets) {
        if (row_of(facet) == row) beds.insert(input_.kit.sheets.places[k].bed + 1);
      }
    }
    return fmt::format("{} {}", beds.size() == 1 ? "sheet" : "sheets", fmt::join(beds, ", "));
  }

  // Names of creases to hinge with panels of a row: with those before it, and within it.
  std::string to_hinge(int row) const {
    std::vector<std::string> names;
    const auto& creases = sheet_.mechanism().creases;
    for (std::size_t c = 0; c < creases.size(); ++c) {
      const bool is_cut = are_apart(input_.options.crease) ||
                          std::ranges::count(input_.kit.cuts, static_cast<int>(c)) > 0;
      if (!is_cut || std::max(row_of(creases[c].left), row_of(creases[c].right)) != row) continue;
      names.push_back(fmt::format("{} ({})", solver::line_label(creases[c].a, creases[c].b),
                                  sheet_.mechanism().is_valley(creases[c]) ? "V" : "M"));
    }
    return names.empty() ? "" : fmt::format(" Hinge {}.", fmt::join(names, ", "));
  }

  std::string rows() const {
    std::set<int> rows;
    for (const int facet : sheet_.panels().facets) rows.insert(row_of(facet));
    std::string text =
        "<li><b>Lay out the panels</b>, row by row, by their numbers; each row is in colour below. "
        "M is a mountain (fold away from you), V a valley.<br>\n";
    for (const int row : rows) {
      text += row_picture(sheet_, row,
                          fmt::format("Row {}: from {}.{}", row, lying_on(row), to_hinge(row)));
    }
    return text + "</li>\n";
  }

  std::string joints() const {
    std::vector<std::vector<std::string>> rows;
    for (const solver::BallJoint& ball : sheet_.mechanism().balls) {
      rows.push_back({solver::vertex_label(ball.vertex), panel_label(sheet_, ball.from_facet),
                      panel_label(sheet_, ball.to_facet)});
    }
    const std::string picture = assembled_picture(sheet_, input_.design.diagonals_name());
    if (rows.empty()) return "<li><b>Compare it with the drawing.</b>\n" + picture + "</li>\n";
    const auto& parts = input_.options.joints;
    return fmt::format("<li><b>Make the ball joints</b> in this order. {}\n",
                       parts ? joint_steps(parts->kind)
                             : "Tie a loop of wire through both panels at each vertex.") +
           page_tables({"vertex", "panel", "panel"}, rows, 3) + picture + "</li>\n";
  }

  // Shapes at a sixth of the rows, half of them, and the angle of use.
  std::string folding() const {
    const Index last = input_.actuation.from_row;
    if (last == 0) return "";
    std::string text =
        "<li><b>Fold the sheet</b> with empty holes. It has one degree of freedom and these "
        "shapes:\n<div class=\"step\">";
    for (const Index at : {std::max<Index>(1, last / 6), std::max<Index>(1, last / 2), last}) {
      const Eigen::Matrix3Xd& shape_mm = sheet_.shapes_mm()[static_cast<std::size_t>(at - 1)];
      text += folded_picture(sheet_, shape_mm,
                             input_.actuation.pilot_deg[static_cast<std::size_t>(at)]);
    }
    return text + "</div></li>\n";
  }

  std::string filling() const {
    const solver::Fill& fill = input_.fill();
    if (std::holds_alternative<solver::NoFill>(fill)) return "";
    const double rest_deg = solver::rest_deg(fill);
    const bool is_springs = std::holds_alternative<solver::Springs>(fill);
    std::string text =
        fmt::format("<li><b>{} and {} the {}</b>, which then are {}.</li>\n",
                    rest_deg == 0 ? std::string("Unfold it flat")
                                  : fmt::format("Fold it to {:.10g}°", rest_deg),
                    is_springs ? "attach" : "bond", fill_nouns(fill).parts, state_words(fill));
    if (input_.design.hold_flat.value_or(false)) {
      text += "<li><b>Add the stop, latch or frame</b> that holds the sheet at flat.</li>\n";
    }
    if (input_.actuation.from_row == 0) return text;
    return text +
           fmt::format(
               "<li><b>Fold it to {:.10g}° and release it.</b> It unfolds to {}.</li>\n",
               input_.from_deg(),
               rest_deg == 0 ? std::string("flat") : fmt::format("its rest at {:.10g}°", rest_deg));
  }

  const GuideInput& input_;
  const solver::Sheet& sheet_;
};

}  // namespace

std::string kit_steps(const GuideInput& input) { return Steps(input).text(); }

}  // namespace misalign::schema
