#include "schema/exchange/drawing.hpp"

#include <fmt/format.h>

#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

constexpr double kMargin_mm = 5;
constexpr double kLabel_mm = 2.88;  // 4 as a font size

class Sheet {
 public:
  explicit Sheet(const Eigen::Matrix2Xd& vertices_mm) : vertices_mm_(vertices_mm) {}

  DrawnPath path(const std::vector<int>& vertices, bool closed) const {
    DrawnPath path{{}, closed};
    for (const int v : vertices) path.points_mm.emplace_back(vertices_mm_.col(v));
    return path;
  }
  DrawnText label(int v) const { return {vertices_mm_.col(v), solver::vertex_label(v), kLabel_mm}; }
  // A number for a diagonal, off the crossing with the hole's other one.
  DrawnText number_of(const solver::Diagonal& diagonal, std::size_t number) const {
    constexpr double kAlong = 0.3;
    const Eigen::Vector2d from = vertices_mm_.col(diagonal.from),
                          to = vertices_mm_.col(diagonal.to);
    return {from + kAlong * (to - from), std::to_string(number), kLabel_mm};
  }

 private:
  const Eigen::Matrix2Xd& vertices_mm_;
};

}  // namespace

LineDrawing crease_pattern_drawing(const Pattern& base, const Eigen::Matrix2Xd& vertices_mm,
                                   const solver::Mechanism& mechanism, const std::string& title) {
  const Sheet sheet(vertices_mm);
  LineLayer springs{"springs", kGreen, true, {}, {}, {}},
      labels{"labels", kGreen, true, {}, {}, {}}, mountains{"mountain", kRed, false, {}, {}, {}},
      valleys{"valley", kBlue, false, {}, {}, {}}, cuts{"cut", kBlack, false, {}, {}, {}};
  for (const auto& outline : solver::outlines(base.base.sheet, base.base.holes)) {
    cuts.paths.push_back(sheet.path(outline, true));
  }
  for (const solver::Crease& crease : mechanism.creases) {
    (mechanism.is_valley(crease) ? valleys : mountains)
        .paths.push_back(sheet.path({crease.a, crease.b}, false));
  }
  for (std::size_t d = 0; d < mechanism.diagonals.size(); ++d) {
    springs.paths.push_back(
        sheet.path({mechanism.diagonals[d].from, mechanism.diagonals[d].to}, false));
    labels.texts.push_back(sheet.number_of(mechanism.diagonals[d], d));
  }
  for (int v = 0; v < vertices_mm.cols(); ++v) labels.texts.push_back(sheet.label(v));
  const Eigen::Vector2d margin_mm(kMargin_mm, kMargin_mm);
  return {title,
          vertices_mm.rowwise().minCoeff() - margin_mm,
          vertices_mm.rowwise().maxCoeff() + margin_mm,
          {springs, labels, mountains, valleys, cuts}};
}

std::string folded_obj(const Pattern& base, const Eigen::Matrix3Xd& shape_mm,
                       const std::string& title) {
  std::string text = "# " + title + "; lengths in mm\n";
  for (Eigen::Index v = 0; v < shape_mm.cols(); ++v) {
    text += fmt::format("v {:.9f} {:.9f} {:.9f}\n", shape_mm(0, v), shape_mm(1, v), shape_mm(2, v));
  }
  for (const int f : solver::kept_facets(base.base.sheet, base.base.holes)) {
    text += "f";
    for (const int v : base.base.sheet.facets[f]) text += " " + std::to_string(v + 1);
    text += "\n";
  }
  return text;
}

}  // namespace misalign::schema
