// Draws a picture of a kit's guide, as SVG within HTML.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

namespace misalign::schema {

/// A picture whose page fits its shapes, y up. Lengths in mm; styles are CSS.
class GuidePicture {
 public:
  void polygon(const std::vector<Eigen::Vector2d>& corners, const std::string& style);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const char* style);
  void dot(const Eigen::Vector2d& at, double radius);
  void text(const Eigen::Vector2d& at, const std::string& words, double size);
  std::string svg(const std::string& caption, bool wide) const;

 private:
  std::string point(const Eigen::Vector2d& at);
  void see(const Eigen::Vector2d& at);

  Eigen::Vector2d least_ = Eigen::Vector2d::Constant(INFINITY), most_ = -least_;
  std::string shapes_;
};

/// The oblique view of a point from above, y away from the reader: x, y and nearness.
Eigen::Vector3d seen_from_aside(const Eigen::Vector3d& at_mm);

}  // namespace misalign::schema
