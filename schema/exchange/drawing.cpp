#include "schema/exchange/drawing.hpp"

#include <fmt/format.h>

#include "schema/files/printable.hpp"
#include "solver/kinematics/folded_springs.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

constexpr double kMargin_mm = 5;
constexpr double kLabel_mm = 2.88;  // capitals of font size 4

class PatternPen {
 public:
  explicit PatternPen(const Eigen::Matrix2Xd& vertices_mm) : vertices_mm_(vertices_mm) {}

  DrawnPath path(const std::vector<int>& vertices, bool closed) const {
    DrawnPath path{{}, closed};
    for (const int v : vertices) path.points_mm.emplace_back(vertices_mm_.col(v));
    return path;
  }
  DrawnText label(int v) const { return {vertices_mm_.col(v), solver::vertex_label(v), kLabel_mm}; }
  // The number of a spring stands off the crossing with the hole's other one.
  static DrawnText number_of(const DrawnPath& spring, std::size_t number) {
    constexpr double kAlong = 0.3;
    const Eigen::Vector2d &from = spring.points_mm[0], &to = spring.points_mm[1];
    return {from + kAlong * (to - from), std::to_string(number), kLabel_mm};
  }

 private:
  const Eigen::Matrix2Xd& vertices_mm_;
};

}  // namespace

LineDrawing crease_pattern_drawing(const Pattern& base, const Eigen::Matrix2Xd& vertices_mm,
                                   const solver::Mechanism& mechanism, const std::string& title,
                                   const std::string& diagonals) {
  const PatternPen pen(vertices_mm);
  LineLayer springs{diagonals, kGreen, LayerUse::hidden, {}, {}, {}},
      labels{"labels", kGreen, LayerUse::hidden, {}, {}, {}},
      mountains{"mountain", kRed, LayerUse::cut, {}, {}, {}},
      valleys{"valley", kBlue, LayerUse::cut, {}, {}, {}},
      cuts{"cut", kBlack, LayerUse::cut, {}, {}, {}};
  for (const auto& outline : solver::outlines(base.base.sheet, base.base.holes)) {
    cuts.paths.push_back(pen.path(outline, true));
  }
  for (const solver::Crease& crease : mechanism.creases) {
    (mechanism.is_valley(crease) ? valleys : mountains)
        .paths.push_back(pen.path({crease.a, crease.b}, false));
  }
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, vertices_mm.cols());
  flat_mm.topRows<2>() = vertices_mm;
  for (std::size_t d = 0; d < mechanism.diagonals.size(); ++d) {
    const solver::FoldedSpring spring(mechanism, mechanism.diagonals[d], flat_mm);
    springs.paths.push_back({{spring.from_mm.head<2>(), spring.to_mm.head<2>()}, false});
    labels.texts.push_back(PatternPen::number_of(springs.paths.back(), d));
  }
  for (int v = 0; v < vertices_mm.cols(); ++v) labels.texts.push_back(pen.label(v));
  const Eigen::Vector2d margin_mm(kMargin_mm, kMargin_mm);
  return {title,
          vertices_mm.rowwise().minCoeff() - margin_mm,
          vertices_mm.rowwise().maxCoeff() + margin_mm,
          {springs, labels, mountains, valleys, cuts}};
}

std::string folded_obj(const Pattern& base, const Eigen::Matrix3Xd& shape_mm,
                       const std::string& title) {
  std::string text = "# " + printable(title) + "; lengths in mm\n";
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
