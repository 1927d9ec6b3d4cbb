// Sheets by parallel redrawing: every crease keeps the direction that it has on the flat base, and
// opposite edges of every hole change by the same vector. Where panels on opposite sides of each
// hole turn alike on the base's path, such a sheet folds by the base's own fold angles, exactly and
// at any size of shifts. README.md has the theorem and its proof.
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

/// Why a base with these holes has no such family.
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

/// The base's holes, and how the panels round them turn on its path; or why there is no family.
/// `misfit_rad` becomes the largest angle by which what must agree there was seen to differ.
std::variant<std::vector<BaseHole>, NoParallelFamily> base_holes(const PerforatedSheet& base,
                                                                 double& misfit_rad);

/// What a coordinate is, in mm.
struct ParallelCoordinate {
  enum class Kind { delta, epsilon, shape } kind;
  int hole;    ///< index into holes(), or -1 of a shape
  int vertex;  ///< of a shape: the vertex whose shift along `axis` it is, the others being zero
  int axis;
};

class ParallelFamily {
 public:
  /// Shifts of `vertices` alone (ascending). Where these are all of the sheet, its first stays
  /// where it is.
  static std::variant<ParallelFamily, NoParallelFamily> of(const PerforatedSheet& base,
                                                           std::vector<int> vertices);

  const std::vector<BaseHole>& holes() const { return holes_; }
  const std::vector<int>& vertices() const { return vertices_; }
  /// delta and epsilon of holes in order, but for those that follow from others; then shapes.
  const std::vector<ParallelCoordinate>& coordinates() const { return coordinates_; }
  int dimension() const { return static_cast<int>(coordinates_.size()); }
  /// x and y of each of `vertices` by coordinate: 2 vertices x coordinates.
  const RowMatrix& basis() const { return basis_; }
  /// delta and epsilon of each hole by coordinate: 2 holes x coordinates.
  const RowMatrix& hole_basis() const { return hole_basis_; }
  /// What each coordinate is to be a whole multiple of, mm, for all shifts to be whole millimetres;
  /// nothing where one shifts vertices by parts that have no such step.
  std::optional<Eigen::VectorXd> whole_steps_mm() const;
  /// The largest angle by which what must agree on the base's path was seen to differ.
  double misfit_rad() const { return misfit_rad_; }

  /// One column per vertex of the sheet.
  Eigen::Matrix2Xd shifts_mm(const Eigen::VectorXd& coordinates_mm) const;
  /// delta and epsilon of each hole in turn, mm.
  Eigen::VectorXd hole_changes_mm(const Eigen::VectorXd& coordinates_mm) const;
  /// The member's coordinates, read off these shifts: exact for a member.
  Eigen::VectorXd coordinates_of(const Eigen::Matrix2Xd& shifts_mm) const;
  /// How the holes of a sheet with these shifts change.
  std::vector<HoleMotion> motions(const Eigen::Matrix2Xd& shifts_mm) const;

 private:
  std::vector<BaseHole> holes_;
  std::vector<int> vertices_;
  std::vector<ParallelCoordinate> coordinates_;
  RowMatrix basis_, hole_basis_;
  FlatVertices base_mm_;
  double misfit_rad_ = 0;
};

/// Where shifts break the conditions most.
struct ParallelMisfit {
  /// How far a crease's end lies beside its direction, or opposite edges of a hole change apart: in
  /// the family 0 but for rounding.
  double mm = 0;
  std::vector<int> vertices{};  ///< of that crease, or round that hole
};

ParallelMisfit parallel_misfit(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm);

/// Shifts within this of the family are a member's, written down: 3e-15 mm of rounding in
/// coordinates of some 10 mm, and as much as a few hundred of them add up to.
inline constexpr double kMemberWithin_mm = 1e-10;

}  // namespace misalign::solver
