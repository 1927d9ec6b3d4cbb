#include "schema/exchange/svg_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "schema/exchange/xml_text.hpp"

namespace misalign::schema {

using Eigen::Vector2d;
using Eigen::Vector3d;

void SvgPicture::polygon(const std::vector<Vector2d>& corners, const std::string& style) {
  std::string points;
  for (const Vector2d& at : corners) points += point(at);
  shapes_ += fmt::format("<polygon points=\"{}\" style=\"{}\"/>", points, style);
}

void SvgPicture::line(const Vector2d& from, const Vector2d& to, const char* style) {
  shapes_ += fmt::format("<polyline points=\"{}{}\" style=\"{}\"/>", point(from), point(to), style);
}

void SvgPicture::dot(const Vector2d& at, double radius) {
  see(at);
  shapes_ +=
      fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>", at.x(), -at.y(), radius);
}

void SvgPicture::text(const Vector2d& at, const std::string& words, double size) {
  see(at);
  shapes_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" text-anchor=\"middle\">{}</text>",
      at.x(), -at.y(), size, xml_text(words));
}

void SvgPicture::label(const Vector2d& at, const std::string& words) {
  see(at);
  shapes_ +=
      fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" dy=\".36em\" text-anchor=\"middle\">{}</text>",
                  at.x(), -at.y(), xml_text(words));
}

double SvgPicture::edge() const { return 0.03 * (most_ - least_).maxCoeff(); }

std::string SvgPicture::view_box() const {
  const Vector2d size = most_ - least_, edge = Vector2d::Constant(this->edge());
  return fmt::format("{:.2f} {:.2f} {:.2f} {:.2f}", least_.x() - edge.x(), -most_.y() - edge.y(),
                     size.x() + 2 * edge.x(), size.y() + 2 * edge.y());
}

std::string SvgPicture::figure(const std::string& caption, FigureSize size) const {
  constexpr double kLetters_mm = 3.6;  // of which a capital takes 0.72
  struct Printed {
    const char* name;
    double width_mm, height_mm;
  };
  constexpr std::array kPrinted = {Printed{"wide", 184, 105}, Printed{"half", 90, 75},
                                   Printed{"third", 59, 60}};
  const Printed& printed = kPrinted[static_cast<std::size_t>(size)];
  const Vector2d drawn = most_ - least_ + Vector2d::Constant(2 * edge());
  const double mm = std::max(drawn.x() / printed.width_mm, drawn.y() / printed.height_mm);
  return fmt::format(
      "<figure class=\"{}\"><svg viewBox=\"{}\" font-size=\"{:.2f}\">{}</svg>"
      "<figcaption>{}</figcaption></figure>\n",
      printed.name, view_box(), kLetters_mm * mm, shapes_, xml_text(caption));
}

std::string SvgPicture::file(const std::string& title) const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{}\" font-family=\"sans-serif\">\n"
      "<title>{}</title>\n{}</svg>\n",
      view_box(), xml_text(title), shapes_);
}

std::string SvgPicture::point(const Vector2d& at) {
  see(at);
  return fmt::format("{:.2f},{:.2f} ", at.x(), -at.y());
}

void SvgPicture::see(const Vector2d& at) {
  least_ = least_.cwiseMin(at);
  most_ = most_.cwiseMax(at);
}

Vector3d seen_from_aside(const Vector3d& at_mm) {
  constexpr double kUp = 0.5, kAside = 0.35;  // sines of elevation, and of the turn
  const double up_cosine = std::sqrt(1 - kUp * kUp), aside_cosine = std::sqrt(1 - kAside * kAside);
  const double x = aside_cosine * at_mm.x() - kAside * at_mm.y();
  const double y = kAside * at_mm.x() + aside_cosine * at_mm.y();
  return {x, kUp * y + up_cosine * at_mm.z(), up_cosine * -y + kUp * at_mm.z()};
}

}  // namespace misalign::schema
