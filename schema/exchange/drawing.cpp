#include "schema/exchange/drawing.hpp"

#include <fmt/format.h>

#include "schema/exchange/xml_text.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

constexpr double kMargin_mm = 5;
constexpr double kLine_mm = 0.1;  // what laser cutters take for a cut or an engraved line

// To a nanometre: the shortest decimal that is still exact for everything a cutter does.
std::string number(double value) {
  std::string shortest = fmt::format("{:.6f}", value);
  shortest.erase(shortest.find_last_not_of('0') + 1);
  if (shortest.back() == '.') shortest.pop_back();
  return shortest == "-0" ? "0" : shortest;
}

// Points of the sheet on the page, whose y goes down.
class Page {
 public:
  explicit Page(const Eigen::Matrix2Xd& vertices_mm)
      : vertices_mm_(vertices_mm),
        least_(vertices_mm.rowwise().minCoeff()),
        most_(vertices_mm.rowwise().maxCoeff()) {}

  std::string width() const { return number(most_.x() - least_.x() + 2 * kMargin_mm); }
  std::string height() const { return number(most_.y() - least_.y() + 2 * kMargin_mm); }
  std::string point(int v) const { return x(vertices_mm_.col(v)) + " " + y(vertices_mm_.col(v)); }
  std::string label(int v) const { return text(vertices_mm_.col(v), solver::vertex_label(v)); }
  // A number for a diagonal, off the crossing with the hole's other one.
  std::string number_of(const solver::Diagonal& diagonal, std::size_t number) const {
    constexpr double kAlong = 0.3;
    const Eigen::Vector2d from = vertices_mm_.col(diagonal.from),
                          to = vertices_mm_.col(diagonal.to);
    return text(from + kAlong * (to - from), std::to_string(number));
  }
  std::string path(const std::vector<int>& vertices, bool closed) const {
    std::string d;
    for (const int v : vertices) d += (d.empty() ? "M " : " L ") + point(v);
    return "    <path d=\"" + d + (closed ? " Z" : "") + "\"/>\n";
  }

 private:
  std::string x(const Eigen::Vector2d& at_mm) const {
    return number(at_mm.x() - least_.x() + kMargin_mm);
  }
  std::string y(const Eigen::Vector2d& at_mm) const {
    return number(most_.y() - at_mm.y() + kMargin_mm);
  }
  std::string text(const Eigen::Vector2d& at_mm, const std::string& words) const {
    return "    <text x=\"" + x(at_mm) + "\" y=\"" + y(at_mm) + "\">" + words + "</text>\n";
  }

  const Eigen::Matrix2Xd& vertices_mm_;
  const Eigen::Vector2d least_, most_;
};

std::string layer(const std::string& name, const std::string& attributes,
                  const std::string& content) {
  return "  <g id=\"" + name + "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + name + "\" " +
         attributes + ">\n" + content + "  </g>\n";
}

}  // namespace

std::string crease_pattern_svg(const Pattern& base, const Eigen::Matrix2Xd& vertices_mm,
                               const solver::Mechanism& mechanism, const std::string& title) {
  const Page page(vertices_mm);
  std::string cuts, mountains, valleys, springs, labels;
  for (const auto& outline : solver::outlines(base.base.sheet, base.base.holes)) {
    cuts += page.path(outline, true);
  }
  for (const solver::Crease& crease : mechanism.creases) {
    (mechanism.is_valley(crease) ? valleys : mountains) += page.path({crease.a, crease.b}, false);
  }
  for (std::size_t d = 0; d < mechanism.diagonals.size(); ++d) {
    springs += page.path({mechanism.diagonals[d].from, mechanism.diagonals[d].to}, false);
    labels += page.number_of(mechanism.diagonals[d], d);
  }
  for (int v = 0; v < vertices_mm.cols(); ++v) labels += page.label(v);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" "
         "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n"
         "     width=\"" +
         page.width() + "mm\" height=\"" + page.height() + "mm\" viewBox=\"0 0 " + page.width() +
         " " + page.height() +
         "\"\n"
         "     fill=\"none\" stroke-width=\"" +
         number(kLine_mm) +
         "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
         "  <title>" +
         xml_text(title) + "</title>\n" +
         layer("springs", "stroke=\"#008000\" style=\"display:none\"", springs) +
         layer("labels",
               "fill=\"#008000\" font-family=\"sans-serif\" font-size=\"4\" "
               "style=\"display:none\"",
               labels) +
         layer("mountain", "stroke=\"#ff0000\"", mountains) +
         layer("valley", "stroke=\"#0000ff\"", valleys) + layer("cut", "stroke=\"#000000\"", cuts) +
         "</svg>\n";
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
