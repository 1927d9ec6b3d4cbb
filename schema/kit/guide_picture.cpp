#include "schema/kit/guide_picture.hpp"

#include <fmt/format.h>

#include "schema/exchange/xml_text.hpp"

namespace misalign::schema {

using Eigen::Vector2d;
using Eigen::Vector3d;

void GuidePicture::polygon(const std::vector<Vector2d>& corners, const std::string& style) {
  std::string points;
  for (const Vector2d& at : corners) points += point(at);
  shapes_ += fmt::format("<polygon points=\"{}\" style=\"{}\"/>", points, style);
}

void GuidePicture::line(const Vector2d& from, const Vector2d& to, const char* style) {
  shapes_ += fmt::format("<polyline points=\"{}{}\" style=\"{}\"/>", point(from), point(to), style);
}

void GuidePicture::dot(const Vector2d& at, double radius) {
  see(at);
  shapes_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" style=\"fill:#c60\"/>",
                         at.x(), -at.y(), radius);
}

void GuidePicture::text(const Vector2d& at, const std::string& words, double size) {
  shapes_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" text-anchor=\"middle\">{}</text>",
      at.x(), -at.y(), size, xml_text(words));
}

std::string GuidePicture::svg(const std::string& caption, bool wide) const {
  const Vector2d size = most_ - least_, edge = Vector2d::Constant(0.03 * size.maxCoeff());
  return fmt::format(
      "<figure{}><svg viewBox=\"{:.2f} {:.2f} {:.2f} {:.2f}\">{}</svg><figcaption>{}</figcaption>"
      "</figure>\n",
      wide ? " class=\"wide\"" : "", least_.x() - edge.x(), -most_.y() - edge.y(),
      size.x() + 2 * edge.x(), size.y() + 2 * edge.y(), shapes_, xml_text(caption));
}

std::string GuidePicture::point(const Vector2d& at) {
  see(at);
  return fmt::format("{:.2f},{:.2f} ", at.x(), -at.y());
}

void GuidePicture::see(const Vector2d& at) {
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
