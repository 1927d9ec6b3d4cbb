// Makes sheets by parallel redrawing: every crease keeps its direction on the flat base, and
// opposite edges of every hole change by the same vector. If panels on opposite sides of each hole
// turn alike on the base's path, such a sheet folds by the base's fold angles, exactly and at any
// size of shifts. README.md has the theorem and its proof.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "solver/pattern/hole_motion.hpp"
#include "solver/pattern/null_space.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

/// Fold angles of opposite edges of a hole, and tangents in proportion to the pilot's, agree to
/// this: coordinates written to 1e-4 mm on 80 mm panels leave 3e-6.
inline constexpr double kTurnsAlike_rad = 1e-5;
/// Opposite edges of a hole on the base agree to this part of the panel width, for the same reason.
inline constexpr double kParallelogram_widths = 1e-5;

/// Reason for which a base with these holes has no parallel family.
struct NoParallelFamily {
  enum class Cause {
    no_parallelogram,  ///< opposite edges of the hole differ, by `off` mm
    turns_apart,       ///< panels on opposite sides of it turn apart, by `off` degrees
    no_fixed_ratio,    ///< tangents of half fold angles are in no fixed ratio, by `off` degrees
  } cause;
  int hole;
  double off, pilot_deg;

  std::string why(const CreasePattern& sheet) const;
};

/// Returns the base's holes with the rotation of their panels on its path, or the reason for which
/// there is no family. `misfit_rad` becomes the largest difference of fold angles that must agree.
std::variant<std::vector<BaseHole>, NoParallelFamily> base_holes(const PerforatedSheet& base,
                                                                 double& misfit_rad);

/// Meaning of a coordinate, in mm.
struct ParallelCoordinate {
  enum class Kind { delta, epsilon, shape } kind;
  int hole;    ///< index into holes(), -1 for a shape
  int vertex;  ///< shape: the vertex whose shift along `axis` this is, if all other coordinates are
               ///< zero
  int axis;
};

class ParallelFamily {
 public:
  /// Only `vertices` (ascending) are shifted. If these are all, the sheet's first vertex is held.
  static std::variant<ParallelFamily, NoParallelFamily> of(const PerforatedSheet& base,
                                                           std::vector<int> vertices);

  const std::vector<BaseHole>& holes() const { return holes_; }
  const std::vector<int>& vertices() const { return vertices_; }
  /// delta and epsilon of holes in order, except those that follow from others; then shapes.
  const std::vector<ParallelCoordinate>& coordinates() const { return coordinates_; }
  int dimension() const { return static_cast<int>(coordinates_.size()); }
  /// x and y of each of `vertices` by coordinate: 2 vertices x coordinates.
  const RowMatrix& basis() const { return basis_; }
  /// delta and epsilon of each hole by coordinate: 2 holes x coordinates.
  const RowMatrix& hole_basis() const { return hole_basis_; }
  /// Steps of the coordinates, mm, of which whole multiples make all shifts whole millimetres; none
  /// if a coordinate has no such step.
  std::optional<Eigen::VectorXd> whole_steps_mm() const;
  /// Largest difference of fold angles that must agree on the base's path.
  double misfit_rad() const { return misfit_rad_; }

  /// One column per vertex of the sheet.
  Eigen::Matrix2Xd shifts_mm(const Eigen::VectorXd& coordinates_mm) const;
  /// delta and epsilon of each hole in turn, mm.
  Eigen::VectorXd hole_changes_mm(const Eigen::VectorXd& coordinates_mm) const;
  /// Motions of the holes of a sheet with these shifts.
  std::vector<HoleMotion> motions(const Eigen::Matrix2Xd& shifts_mm) const;

 private:
  std::vector<BaseHole> holes_;
  std::vector<int> vertices_;
  std::vector<ParallelCoordinate> coordinates_;
  RowMatrix basis_, hole_basis_;
  FlatVertices base_mm_;
  double misfit_rad_ = 0;
};

/// The largest violation of the family's conditions by shifts.
struct ParallelMisfit {
  /// Distance of a crease's end from its direction, or difference of the changes of a hole's
  /// opposite edges; 0 up to rounding in the family.
  double mm = 0;
  std::vector<int> vertices{};  ///< vertices of that crease or hole
};

ParallelMisfit parallel_misfit(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm);

/// Shifts within this of the family are those of a member: rounding leaves 3e-15 mm in coordinates
/// of some 10 mm, and a few hundred of these add up.
inline constexpr double kMemberWithin_mm = 1e-10;

}  // namespace misalign::solver
