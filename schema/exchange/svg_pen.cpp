#include "schema/exchange/svg_pen.hpp"

#include <fmt/format.h>

#include "schema/exchange/xml_text.hpp"

namespace misalign::schema {
namespace {

constexpr double kLine_mm = 0.1;     // a cut or an engraved line for laser cutters
constexpr double kCapitalEm = 0.72;  // height of a capital in most typefaces

// A length to a nanometre, which is exact for any cutter, as the shortest decimal.
std::string number(double value) {
  std::string shortest = fmt::format("{:.6f}", value);
  shortest.erase(shortest.find_last_not_of('0') + 1);
  if (shortest.back() == '.') shortest.pop_back();
  return shortest == "-0" ? "0" : shortest;
}

// Points of the drawing on the page, whose y goes down.
class Page {
 public:
  explicit Page(const LineDrawing& drawing) : least_(drawing.least_mm), most_(drawing.most_mm) {}

  Eigen::Vector2d size_mm() const { return most_ - least_; }
  std::string path(const DrawnPath& path) const {
    std::string d;
    for (const Eigen::Vector2d& at_mm : path.points_mm) {
      d += (d.empty() ? "M " : " L ") + x(at_mm) + " " + y(at_mm);
    }
    return "    <path d=\"" + d + (path.closed ? " Z" : "") + "\"/>\n";
  }
  std::string circle(const DrawnCircle& circle) const {
    return "    <circle cx=\"" + x(circle.centre_mm) + "\" cy=\"" + y(circle.centre_mm) +
           "\" r=\"" + number(circle.radius_mm) + "\"/>\n";
  }
  // `height_mm`: the height of the layer's texts, which a text of the same height inherits.
  std::string text(const DrawnText& text, double height_mm) const {
    return "    <text x=\"" + x(text.at_mm) + "\" y=\"" + y(text.at_mm) + "\"" +
           (text.height_mm == height_mm ? "" : " font-size=\"" + font_size(text.height_mm) + "\"") +
           ">" + xml_text(text.words) + "</text>\n";
  }
  static std::string font_size(double height_mm) { return number(height_mm / kCapitalEm); }

 private:
  std::string x(const Eigen::Vector2d& at_mm) const { return number(at_mm.x() - least_.x()); }
  std::string y(const Eigen::Vector2d& at_mm) const { return number(most_.y() - at_mm.y()); }

  const Eigen::Vector2d least_, most_;
};

std::string layer_of(const Page& page, const LineLayer& layer) {
  std::string lines, words;
  for (const DrawnPath& path : layer.paths) lines += page.path(path);
  for (const DrawnCircle& circle : layer.circles) lines += page.circle(circle);
  const double height_mm = layer.texts.empty() ? 0 : layer.texts[0].height_mm;
  for (const DrawnText& text : layer.texts) words += page.text(text, height_mm);
  const std::string stroke = "stroke=\"" + layer.colour.rgb + "\"";
  const std::string type = "fill=\"" + layer.colour.rgb +
                           "\" font-family=\"sans-serif\" font-size=\"" +
                           Page::font_size(height_mm) + "\"";
  const bool both = !lines.empty() && !words.empty();
  if (both) words = "    <g stroke=\"none\" " + type + ">\n" + words + "    </g>\n";
  return "  <g id=\"" + layer.name + "\" inkscape:groupmode=\"layer\" inkscape:label=\"" +
         layer.name + "\" " + (lines.empty() && !words.empty() ? type : stroke) +
         (layer.use == LayerUse::hidden ? " style=\"display:none\"" : "") + ">\n" + lines + words +
         "  </g>\n";
}

}  // namespace

std::string svg_of(const LineDrawing& drawing) {
  const Page page(drawing);
  const Eigen::Vector2d size_mm = page.size_mm();
  const auto length = [&](double length_mm) {
    return number(in_unit(length_mm, drawing.unit)) + name_of(drawing.unit);
  };
  std::string layers;
  for (const LineLayer& layer : drawing.layers) layers += layer_of(page, layer);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<svg xmlns=\"http://www.w3.org/2000/svg\" "
         "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n"
         "     width=\"" +
         length(size_mm.x()) + "\" height=\"" + length(size_mm.y()) + "\" viewBox=\"0 0 " +
         number(size_mm.x()) + " " + number(size_mm.y()) +
         "\"\n"
         "     fill=\"none\" stroke-width=\"" +
         number(kLine_mm) +
         "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
         "  <title>" +
         xml_text(drawing.title) + "</title>\n" + layers + "</svg>\n";
}

}  // namespace misalign::schema
