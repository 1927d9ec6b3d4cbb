#include "schema/kit/kit_guide.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/exchange/xml_text.hpp"
#include "schema/kit/joint_words.hpp"
#include "schema/kit/kit_hinges.hpp"
#include "schema/kit/kit_parts.hpp"
#include "schema/kit/kit_springs.hpp"
#include "schema/kit/page_parts.hpp"
#include "schema/kit/sheet_pictures.hpp"
#include "schema/pattern/fill_words.hpp"
#include "solver/motion/plates.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;

class Guide {
 public:
  explicit Guide(const GuideInput& input)
      : input_(input),
        sheet_(input.sheet),
        mechanism_(input.sheet.mechanism()),
        fittings_(kit_fittings(input.sheet, input.options)),
        springs_(kit_springs(input.sheet, fittings_)) {}

  std::string page() const {
    std::string text = page_begin(input_.title);
    if (!input_.warning.empty()) {
      text += "<p class=\"warning\">" + xml_text(input_.warning) + "</p>\n";
    }
    return text + bill() +
           hinge_table(sheet_, input_.design.thickness_mm, input_.actuation.from_row, from_deg()) +
           joint_section(sheet_, input_.options) + filling() + assembly() + kPageEnd;
  }

 private:
  double from_deg() const {
    return input_.actuation.pilot_deg[static_cast<std::size_t>(input_.actuation.from_row)];
  }

  std::string bill() const {
    const char* made = are_apart(input_.options.crease)            ? "film or textile"
                       : input_.options.crease == CreaseCut::score ? "scored"
                                                                   : "perforated";
    const solver::Plates plates = input_.design.plates();
    double mass_t = 0;
    for (const solver::PanelMass& panel :
         solver::panel_masses(plates, sheet_.panels().corners, sheet_.vertices_mm())) {
      mass_t += panel.mass_t;
    }
    std::string text =
        "<h2>Parts</h2>\n<table>\n" + table_row({"part", "number", "amount"}, 1, "th");
    text += table_row({"panels", std::to_string(sheet_.panels().facets.size()),
                       fmt::format("{:.0f} cm² of sheet", mass_t / plates.area_density() / 100)},
                      1);
    if (input_.design.thickness_mm) {
      text += table_row({fmt::format("  {:g} mm thick, {:g} g/cm³", plates.thickness_mm,
                                     plates.density_g_per_cm3),
                         "", fmt::format("{:.1f} g", 1e6 * mass_t)},
                        1);
    }
    for (const bool valley : {false, true}) {
      const KitHinges hinges(sheet_, valley, input_.actuation.from_row);
      text += table_row({fmt::format("hinges, {}, {}", hinges.name, made),
                         std::to_string(hinges.count), fmt::format("{:.0f} mm", hinges.length_mm)},
                        1);
    }
    const auto& bore_mm = input_.options.joint_bore_mm;
    text +=
        table_row({"ball joints: loops of wire", std::to_string(mechanism_.balls.size()),
                   bore_mm ? fmt::format("bores of {:g} mm", *bore_mm) : std::string("no bores")},
                  1);
    text += table_row(
        {fill_words(fill(), mechanism_.diagonal_count()), std::to_string(filling_parts()),
         fmt::format(
             "{:.4g} N mm at {:.10g}°",
             input_.actuation.energy_n_mm[static_cast<std::size_t>(input_.actuation.from_row)],
             from_deg())},
        1);
    text += "</table>\n";
    if (input_.contact && input_.contact->thickness) {
      const bool meets = input_.contact->reach_deg < input_.contact->used_from_deg;
      text +=
          meets
              ? fmt::format(
                    "<p>Panels come into contact at {:.4g}°: plates of no thickness reach "
                    "{:.10g}°.</p>\n",
                    input_.contact->reach_deg, input_.contact->used_from_deg)
              : fmt::format(
                    "<p>Largest panel thickness to fold to {:.10g}°: {:.3g} mm, with hinges at the "
                    "mid-plane, edges tapered at creases, and corners trimmed by {:g} mm.</p>\n",
                    input_.contact->used_from_deg, input_.contact->thickness->thickness_mm,
                    input_.contact->trim_mm);
    }
    return text;
  }

  const solver::Fill& fill() const { return input_.actuation.actuators.fill; }

  // Number of springs or plates.
  Index filling_parts() const {
    const solver::Filling filling = solver::filling_of(sheet_, fill());
    return filling.is_springs() ? (filling.rates_n_per_mm().array() > 0).count() : filling.holes();
  }

  std::string filling() const {
    return filling_table(sheet_, input_.actuation, [&](int d) { return lengths_mm(d); });
  }

  // Lengths of a spring when flat and at the angle of use; of its diagonal where the kit has no
  // ends.
  SpringLengths lengths_mm(int d) const {
    for (const KitSpring& spring : springs_) {
      if (spring.from.spring != d) continue;
      const auto at = static_cast<std::size_t>(input_.actuation.from_row);
      return {spring.length_mm.front(), spring.length_mm[at]};
    }
    return diagonal_lengths(sheet_, input_.actuation, d);
  }

  std::string assembly() const {
    const std::vector<KitPart> parts = kit_parts(sheet_, input_.options.crease);
    std::string text = "<h2>Assembly</h2>\n<ol>\n<li>Cut the parts. Each panel has its number.";
    std::vector<std::string> loose;
    for (std::size_t p = 1; p < parts.size() && !are_apart(input_.options.crease); ++p) {
      for (const int f : parts[p].facets) loose.push_back(panel_label(sheet_, f));
    }
    if (!loose.empty()) {
      text += fmt::format(" Ball joints alone hold {}.", fmt::join(loose, ", "));
    }
    text += "</li>\n" + exploded_picture(sheet_);
    text += are_apart(input_.options.crease)
                ? "<li>Hinge the panels along all creases, at half their thickness.</li>\n"
                : "<li>Fold each crease once by hand, mountains away from you, valleys towards "
                  "you.</li>\n";
    text +=
        "<li>Tie the ball joints in this order: a loop of wire through both panels at each "
        "vertex.</li>\n<table>\n" +
        table_row({"vertex", "panel", "panel"}, 3, "th");
    for (const solver::BallJoint& ball : mechanism_.balls) {
      text += table_row({solver::vertex_label(ball.vertex), panel_label(sheet_, ball.from_facet),
                         panel_label(sheet_, ball.to_facet)},
                        3);
    }
    text += "</table>\n" + assembled_picture(sheet_, input_.design.diagonals_name());
    text +=
        "<li>Fold the sheet with empty holes. It has one degree of freedom and these "
        "shapes:</li>\n" +
        folded();
    if (std::holds_alternative<solver::NoFill>(fill())) return text + "</ol>\n";
    const double rest_deg = solver::rest_deg(fill());
    const bool is_springs = std::holds_alternative<solver::Springs>(fill());
    return text + fmt::format(
                      "<li>{} and {} the {}, which then are {}.</li>\n<li>Fold and release "
                      "it.</li>\n</ol>\n",
                      rest_deg == 0 ? std::string("Unfold it flat")
                                    : fmt::format("Fold it to {:.10g}°", rest_deg),
                      is_springs ? "attach" : "bond", fill_nouns(fill()).parts,
                      state_words(fill()));
  }

  // Shapes at a sixth of the rows, half of them, and the angle of use.
  std::string folded() const {
    const Index last = input_.actuation.from_row;
    std::string text;
    for (const Index at : {std::max<Index>(1, last / 6), std::max<Index>(1, last / 2), last}) {
      if (at == 0) continue;
      const Eigen::Matrix3Xd& shape_mm = sheet_.shapes_mm()[static_cast<std::size_t>(at - 1)];
      text += folded_picture(sheet_, shape_mm,
                             input_.actuation.pilot_deg[static_cast<std::size_t>(at)]);
    }
    return text;
  }

  const GuideInput& input_;
  const solver::Sheet& sheet_;
  const solver::Mechanism& mechanism_;
  const KitFittings fittings_;
  const std::vector<KitSpring> springs_;
};

}  // namespace

std::string kit_guide(const GuideInput& input) { return Guide(input).page(); }

}  // namespace misalign::schema
