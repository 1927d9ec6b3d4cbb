// Draws a picture of a sheet as SVG, for a page or a file of its own.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

namespace misalign::schema {

/// Size of a figure on a printed page of A4: one, two or three fit side by side.
enum class FigureSize { wide, half, third };

/// A picture whose page fits its shapes, y up. Lengths in mm; styles are CSS.
class SvgPicture {
 public:
  void polygon(const std::vector<Eigen::Vector2d>& corners, const std::string& style);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const char* style);
  void dot(const Eigen::Vector2d& at, double radius);
  void text(const Eigen::Vector2d& at, const std::string& words, double size);
  /// Words centred on a point, at least 2.5 mm high when a figure of it is printed.
  void label(const Eigen::Vector2d& at, const std::string& words);
  /// Corners of all shapes' bounds.
  const Eigen::Vector2d& least() const { return least_; }
  const Eigen::Vector2d& most() const { return most_; }
  /// The picture within HTML.
  std::string figure(const std::string& caption, FigureSize size) const;
  /// The picture as a file.
  std::string file(const std::string& title) const;

 private:
  std::string point(const Eigen::Vector2d& at);
  void see(const Eigen::Vector2d& at);
  std::string view_box() const;
  double edge() const;

  Eigen::Vector2d least_ = Eigen::Vector2d::Constant(INFINITY), most_ = -least_;
  std::string shapes_;
};

/// The oblique view of a point from above, y away from the reader: x, y and nearness.
Eigen::Vector3d seen_from_aside(const Eigen::Vector3d& at_mm);

}  // namespace misalign::schema
