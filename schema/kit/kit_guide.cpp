#include "schema/kit/kit_guide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "schema/exchange/xml_text.hpp"
#include "schema/files/printable.hpp"
#include "schema/kit/guide_picture.hpp"
#include "schema/kit/kit_hinges.hpp"
#include "schema/kit/kit_parts.hpp"
#include "schema/kit/kit_springs.hpp"
#include "solver/design/plates.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr const char* kStyle =
    "body{font:14px sans-serif;max-width:46em;margin:1em auto;padding:0 1em}"
    "table{border-collapse:collapse;margin:.5em 0}td,th{border:1px solid #999;padding:.2em .6em;"
    "text-align:left}td.n{text-align:right}svg{width:100%;max-height:24em}"
    "figure{display:inline-block;width:32%;margin:0;vertical-align:top}figure.wide{width:100%}"
    ".warning{border:2px solid #c00;padding:.5em}@media print{h2{break-after:avoid}}";

// A table's row; cells from `numbers` on are to the right.
std::string row(const std::vector<std::string>& cells, std::size_t numbers,
                const char* cell = "td") {
  std::string text = "<tr>";
  for (std::size_t c = 0; c < cells.size(); ++c) {
    text += fmt::format("<{0}{1}>{2}</{0}>", cell, c >= numbers ? " class=\"n\"" : "",
                        xml_text(cells[c]));
  }
  return text + "</tr>\n";
}

class Guide {
 public:
  explicit Guide(const GuideInput& input)
      : input_(input),
        sheet_(input.sheet),
        mechanism_(input.sheet.mechanism()),
        fittings_(kit_fittings(input.sheet, input.options)),
        springs_(kit_springs(input.sheet, fittings_)) {}

  std::string page() const {
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
        "<style>{1}</style></head><body>\n<h1>{0}</h1>\n",
        xml_text(printable(utf8(input_.title))), kStyle);
    if (!input_.warning.empty()) {
      text += "<p class=\"warning\">" + xml_text(input_.warning) + "</p>\n";
    }
    return text + bill() + hinge_table() + springs() + assembly() + "</body></html>\n";
  }

 private:
  double from_deg() const {
    return input_.actuation.pilot_deg[static_cast<std::size_t>(input_.actuation.from_row)];
  }

  std::string hinge_table() const {
    const auto& thickness_mm = input_.design.thickness_mm;
    std::string text =
        "<h2>Hinges</h2>\n<table>\n" +
        row({"hinges", "butted: on the face that", "fold at most to",
             thickness_mm
                 ? fmt::format("or a film at half thickness: gap for {:g} mm", *thickness_mm)
                 : "or a film at half thickness: gap for each mm",
             "or edges bevelled by"},
            2, "th");
    for (const bool valley : {false, true}) {
      const KitHinges some(sheet_, valley, input_.actuation.from_row);
      text += row({some.name, some.face, fmt::format("{:.1f}°", some.fold_deg),
                   fmt::format("{:.2f} mm", some.gap_mm(thickness_mm.value_or(1))),
                   fmt::format("{:.1f}°", some.bevel_deg())},
                  2);
    }
    return text + fmt::format(
                      "</table>\n<p>Up to {:.10g}°. Panels that are butted close on the "
                      "side of their hinge only.</p>\n",
                      from_deg());
  }

  std::string bill() const {
    const char* made = input_.options.crease == CreaseCut::cut     ? "tape or textile"
                       : input_.options.crease == CreaseCut::score ? "scored"
                                                                   : "perforated";
    const solver::Plates plates = input_.design.plates();
    double mass_t = 0;
    for (const solver::PanelMass& panel :
         solver::panel_masses(plates, sheet_.panels().corners, sheet_.vertices_mm())) {
      mass_t += panel.mass_t;
    }
    std::string text =
        "<h2>What it takes</h2>\n<table>\n" + row({"what", "how many", "how much"}, 1, "th");
    text += row({"panels", std::to_string(sheet_.panels().facets.size()),
                 fmt::format("{:.0f} cm² of sheet", mass_t / plates.area_density() / 100)},
                1);
    if (input_.design.thickness_mm) {
      text += row({fmt::format("  {:g} mm thick, {:g} g/cm³", plates.thickness_mm,
                               plates.density_g_per_cm3),
                   "", fmt::format("{:.1f} g", 1e6 * mass_t)},
                  1);
    }
    for (const bool valley : {false, true}) {
      const KitHinges some(sheet_, valley, input_.actuation.from_row);
      text += row({fmt::format("hinges, {}, {}", some.name, made), std::to_string(some.count),
                   fmt::format("{:.0f} mm", some.length_mm)},
                  1);
    }
    const auto& bore_mm = input_.options.joint_bore_mm;
    text += row({"ball joints: loops of wire", std::to_string(mechanism_.balls.size()),
                 bore_mm ? fmt::format("bores of {:g} mm", *bore_mm) : std::string("no bores")},
                1);
    text +=
        row({fmt::format("springs of {:g} N/mm", input_.actuation.actuators.stiffness_n_per_mm),
             std::to_string(mechanism_.diagonal_count()),
             fmt::format(
                 "{:.4g} N mm stored at {:.10g}°",
                 input_.actuation.energy_n_mm[static_cast<std::size_t>(input_.actuation.from_row)],
                 from_deg())},
            1);
    text += "</table>\n";
    if (input_.contact && input_.contact->thickness) {
      const bool meets = input_.contact->reach_deg < input_.contact->used_from_deg;
      text += meets
                  ? fmt::format(
                        "<p>Panels meet on the way, at {:.4g}°: no plate reaches {:.10g}°.</p>\n",
                        input_.contact->reach_deg, input_.contact->used_from_deg)
                  : fmt::format(
                        "<p>Plates may be up to {:.3g} mm thick to fold to {:.10g}°: hinged at the "
                        "mid-plane, tapered towards the creases, corners trimmed by {:g} mm.</p>\n",
                        input_.contact->thickness->thickness_mm, input_.contact->used_from_deg,
                        input_.contact->trim_mm);
    }
    return text;
  }

  // Lengths of a spring flat, and at the angle of use: between its own ends where the kit has them.
  std::pair<double, double> lengths_mm(int d) const {
    const Index at = input_.actuation.from_row;
    for (const KitSpring& spring : springs_) {
      if (spring.from.spring != d) continue;
      return {spring.length_mm.front(), spring.length_mm[static_cast<std::size_t>(at)]};
    }
    const auto column = static_cast<std::size_t>(d);
    const double flat_mm = sheet_.history().flat_mm[column];
    return {flat_mm, at == 0 ? flat_mm : sheet_.history().length_mm(at - 1, d)};
  }

  std::string springs() const {
    const double stiffness = input_.actuation.actuators.stiffness_n_per_mm;
    std::vector<int> few;
    if (input_.actuation.few) few = input_.actuation.few->diagonals;
    std::string text = fmt::format(
        "<h2>Springs</h2>\n<p>All are relaxed where the sheet is flat; folded to {:.10g}° a spring "
        "that is longer "
        "then pulls, one that is shorter pushes.</p>\n<table>\n",
        from_deg());
    text += row({"no.", "from vertex to vertex", "does", "enough", "free, mm", "folded, mm",
                 "stroke, %", "force, N"},
                4, "th");
    double largest_n = 0;
    for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
      const auto [free_mm, folded_mm] = lengths_mm(d);
      const double force_n = stiffness * std::abs(folded_mm - free_mm);
      largest_n = std::max(largest_n, force_n);
      const solver::Diagonal& diagonal = mechanism_.diagonals[static_cast<std::size_t>(d)];
      text += row(
          {"s" + std::to_string(d), solver::line_label(diagonal.from, diagonal.to),
           folded_mm >= free_mm ? "pulls" : "pushes", std::ranges::count(few, d) > 0 ? "yes" : "",
           fmt::format("{:.2f}", free_mm), fmt::format("{:.2f}", folded_mm),
           fmt::format("{:+.2f}", 100 * (folded_mm / free_mm - 1)), fmt::format("{:.3g}", force_n)},
          4);
    }
    text += fmt::format("</table>\n<p>The largest force is {:.3g} N.", largest_n);
    if (!few.empty()) {
      text +=
          fmt::format(" Those marked “enough”, {} of {}, keep {:.0f} % of the least moment of all.",
                      few.size(), mechanism_.diagonal_count(), 100 * input_.actuation.few->share);
    }
    return text + "</p>\n";
  }

  std::string assembly() const {
    const std::vector<KitPart> parts = kit_parts(sheet_, input_.options.crease);
    std::string text =
        "<h2>Putting it together</h2>\n<ol>\n<li>Cut the parts. Each panel has its number.";
    std::vector<std::string> loose;
    for (std::size_t p = 1; p < parts.size() && input_.options.crease != CreaseCut::cut; ++p) {
      for (const int f : parts[p].facets) loose.push_back(panel_label(sheet_, f));
    }
    if (!loose.empty()) {
      text += fmt::format(" {} hang in ball joints alone.", fmt::join(loose, ", "));
    }
    text += "</li>\n" + exploded();
    text += input_.options.crease == CreaseCut::cut
                ? "<li>Hinge the panels along all creases, each on the side on which it closes: "
                  "valleys on the face that looks up, mountains on the other.</li>\n"
                : "<li>Fold each crease once by hand, mountains away from you, valleys towards "
                  "you.</li>\n";
    text +=
        "<li>Tie the ball joints, in this order: a loop of wire through both panels, at the "
        "vertex.</li>\n<table>\n" +
        row({"vertex", "panel", "panel"}, 3, "th");
    for (const solver::BallJoint& ball : mechanism_.balls) {
      text += row({solver::vertex_label(ball.vertex), panel_label(sheet_, ball.from_facet),
                   panel_label(sheet_, ball.to_facet)},
                  3);
    }
    text += "</table>\n" + assembled();
    text +=
        "<li>Fold the sheet, without springs: it has one way to go. It looks like this:</li>\n" +
        folded();
    return text +
           "<li>Unfold it flat, and hang in the springs, which then are relaxed.</li>\n<li>Fold "
           "it, and let go."
           "</li>\n</ol>\n";
  }

  std::vector<Vector2d> corners_mm(std::size_t panel) const {
    std::vector<Vector2d> at;
    for (const int v : sheet_.panels().corners[panel]) at.push_back(sheet_.point_mm(v));
    return at;
  }
  static Vector2d middle(const std::vector<Vector2d>& corners) {
    return std::accumulate(corners.begin(), corners.end(), Vector2d(0, 0)) / 4.0;
  }

  double size_mm() const { return mechanism_.panel_width_mm; }

  // Parts apart, each as far from the middle as a quarter more than it lies.
  std::string exploded() const {
    constexpr double kApart = 0.25;
    GuidePicture picture;
    const Vector2d centre = 0.5 * (sheet_.vertices_mm().rowwise().minCoeff() +
                                   sheet_.vertices_mm().rowwise().maxCoeff());
    for (std::size_t p = 0; p < sheet_.panels().facets.size(); ++p) {
      std::vector<Vector2d> corners = corners_mm(p);
      const Vector2d by = kApart * (middle(corners) - centre);
      for (Vector2d& at : corners) at += by;
      picture.polygon(corners, "fill:#eef;stroke:#333;stroke-width:.6");
      picture.text(middle(corners), panel_label(sheet_, sheet_.panels().facets[p]),
                   0.18 * size_mm());
    }
    return picture.svg("All panels, taken apart", true);
  }

  std::string assembled() const {
    GuidePicture picture;
    for (std::size_t p = 0; p < sheet_.panels().facets.size(); ++p) {
      picture.polygon(corners_mm(p), "fill:#eef;stroke:none");
    }
    for (const solver::Crease& crease : mechanism_.creases) {
      picture.line(
          sheet_.point_mm(crease.a), sheet_.point_mm(crease.b),
          mechanism_.is_valley(crease) ? "stroke:#06c;stroke-dasharray:4 3" : "stroke:#c00");
    }
    for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
      const solver::Diagonal& diagonal = mechanism_.diagonals[static_cast<std::size_t>(d)];
      const Vector2d from = sheet_.point_mm(diagonal.from), to = sheet_.point_mm(diagonal.to);
      picture.line(from, to, "stroke:#393");
      picture.text(from + 0.3 * (to - from), "s" + std::to_string(d), 0.14 * size_mm());
    }
    for (const solver::BallJoint& ball : mechanism_.balls) {
      picture.dot(sheet_.point_mm(ball.vertex), 0.05 * size_mm());
      picture.text(sheet_.point_mm(ball.vertex) + Vector2d(0, 0.08 * size_mm()),
                   solver::vertex_label(ball.vertex), 0.14 * size_mm());
    }
    return picture.svg("Mountains red, valleys blue and dashed, springs green, ball joints dots",
                       true);
  }

  // At a sixth of the way, half of it, and the angle of use.
  std::string folded() const {
    const Index last = input_.actuation.from_row;
    std::string text;
    for (const Index at : {std::max<Index>(1, last / 6), std::max<Index>(1, last / 2), last}) {
      if (at == 0) continue;
      const Eigen::Matrix3Xd& shape_mm = sheet_.shapes_mm()[static_cast<std::size_t>(at - 1)];
      text += folded(shape_mm, input_.actuation.pilot_deg[static_cast<std::size_t>(at)]);
    }
    return text;
  }

  // The farthest panels first.
  std::string folded(const Eigen::Matrix3Xd& shape_mm, double pilot_deg) const {
    struct Seen {
      double near;
      std::vector<Vector2d> corners;
      bool from_above;
    };
    std::vector<Seen> panels;
    for (const auto& corners : sheet_.panels().corners) {
      Seen panel{0, {}, true};
      for (const int v : corners) {
        const Vector3d at = seen_from_aside(shape_mm.col(v));
        panel.corners.push_back(at.head<2>());
        panel.near += at.z();
      }
      const Vector2d one = panel.corners[2] - panel.corners[0],
                     other = panel.corners[3] - panel.corners[1];
      panel.from_above = one.x() * other.y() - one.y() * other.x() > 0;
      panels.push_back(std::move(panel));
    }
    std::ranges::stable_sort(panels, {}, &Seen::near);
    GuidePicture picture;
    for (const Seen& panel : panels) {
      picture.polygon(panel.corners, panel.from_above ? "fill:#dde;stroke:#333;stroke-width:.6"
                                                      : "fill:#fe9;stroke:#333;stroke-width:.6");
    }
    return picture.svg(fmt::format("Pilot at {:.10g}°", pilot_deg), false);
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
