// Makes the Miura-ori of the paper (section 4, figure 12) with columns of any width and rows of any
// height.
#pragma once

#include <vector>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::solver {

/// Line i of vertices lies at y = the heights of the rows below it, shifted along x by the offsets
/// of those rows, of even rows to the right and of odd ones back to the left; its vertex j at x =
/// the widths of the columns before it. The left and the right border are straight lines, as far
/// out as the lines of vertices go.
struct MiuraShape {
  std::vector<double> width_mm;   ///< per column
  std::vector<double> height_mm;  ///< per row
  std::vector<double> offset_mm;  ///< per row: atan(height / offset) is its sector angle

  int rows() const { return static_cast<int>(height_mm.size()); }
  int columns() const { return static_cast<int>(width_mm.size()); }
  /// Equal panels.
  static MiuraShape uniform(int rows, int columns, double width_mm, double height_mm,
                            double offset_mm);
};

/// Vertices and facets row by row; the mean panel width is the length scale.
CreasePattern miura_sheet(const MiuraShape& shape);

/// Mountains and valleys, per edge of the sheet; 0 on the perimeter. Zigzag lines are valley and
/// mountain in turn, the first a valley; straight creases change their sign at every vertex.
std::vector<int> miura_assignment(const MiuraShape& shape, const CreasePattern& sheet);

}  // namespace misalign::solver
