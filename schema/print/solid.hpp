// A closed solid as triangles, and how it is put together.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

struct Solid {
  std::string name;
  std::vector<Eigen::Vector3d> vertices_mm;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Joins triangles at their corners: points that are equal after rounding to 1e-6 mm are one.
class SolidMaker {
 public:
  /// Adds a triangle, unless two of its corners are one.
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  /// Adds a quadrilateral as two triangles.
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
           const Eigen::Vector3d& d);
  /// Adds a flat polygon with holes, whose points are `origin` + x `across` + y `along`; it is seen
  /// counter-clockwise from where these axes turn left.
  void add(const std::vector<PlanePoints>& rings, const Eigen::Vector3d& origin,
           const Eigen::Vector3d& across, const Eigen::Vector3d& along);

  Solid solid(std::string name) &&;

 private:
  int number_of(const Eigen::Vector3d& point);

  Solid solid_;
  std::map<std::array<double, 3>, int> numbers_;
};

}  // namespace misalign::schema
