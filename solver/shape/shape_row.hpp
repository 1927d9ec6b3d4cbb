// A constraint of a sheet while it is shaped, and which constraints are wanted.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace misalign::solver {

/// Rows beside those of every shape.
struct WantedRows {
  explicit WantedRows(double least_limit_deg = 0) : limit_deg(least_limit_deg) {}

  double limit_deg;  ///< least fold limit
  /// Pilot angles between which rows hold, ascending, without flat.
  std::vector<double> angles_deg = {};
  Eigen::VectorXd sides = {};  ///< 1 longer, -1 shorter: per diagonal; empty: no directions
  bool has_wells = false;
  /// Per floor its present level, on the way to the one asked for, and the mm by which vertices
  /// move for one unit of its goal; empty: no floors.
  struct Level {
    double least, mm;
  };
  std::vector<Level> floors = {};
};

/// slack + by_mm . (change of the flat vertices) >= 0; mm, or panel widths times rad.
struct ShapeRow {
  enum class Kind {
    corner,
    edge,
    fold,
    limit,
    direction,
    energy,
    equal,
    barrier,
    floor,
    amplitude
  } kind;
  int where;  ///< facet, edge, crease, diagonal or floor
  double pilot_deg;
  double slack;
  Eigen::RowVectorXd by_mm;  ///< x and y of each vertex in turn; empty if it was not asked for
};

}  // namespace misalign::solver
