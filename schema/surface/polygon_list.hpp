// Points and polygons as a file of a surface lists them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::schema {

struct PolygonList {
  std::vector<Eigen::Vector3d> points_mm;
  std::vector<std::vector<int>> faces;  ///< corners in order; they may be no points
};

inline constexpr std::size_t kMostPolygons = 400000;

/// Counts faults of one kind, and keeps the first, for one sentence.
class FaultKind {
 public:
  template <class Say>
  void see(const Say& say) {
    if (count_++ == 0) first_ = say();
  }
  void report(const std::string& why, const std::string& suggestion, InputFaults& faults) const;

 private:
  std::size_t count_ = 0;
  std::string first_;
};

/// Reads OBJ, STL or PLY by the beginning and the size of its bytes; an STL file of binary numbers
/// may begin like one of text. Coordinates are taken as millimetres. Every other property is
/// ignored.
PolygonList read_polygons(std::string_view bytes, const std::string& name, InputFaults& faults);

/// The formats, of which the first has faces by numbers from 1 or back from the end, the second
/// three points for each.
PolygonList read_obj_polygons(std::string_view text, InputFaults& faults);
PolygonList read_stl_text(std::string_view text, InputFaults& faults);
PolygonList read_stl_bytes(std::string_view bytes);
PolygonList read_ply(std::string_view bytes, InputFaults& faults);

}  // namespace misalign::schema
