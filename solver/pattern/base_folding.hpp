// The folding of the correct (unshifted, unperforated) sheet: the starting values of every path. By
// the sequential method: each vertex of degree four gives its other fold angles from one.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "solver/pattern/crease_pattern.hpp"
#include "solver/pattern/degree_four.hpp"

namespace misalign::solver {

/// Where the fold angles that two vertices give to one crease differ by no more than this part of
/// the pilot's angle, the loops close: coordinates written to 1e-4 mm on 80 mm panels leave a tenth
/// of it, and the path's Newton steps take off a hundred times as much.
inline constexpr double kBaseClosure = 1e-4;

/// Mountains and valleys as seen from the side where the pilot is a valley.
class BaseFolding {
 public:
  /// One vertex: its creases counter-clockwise, the one whose angle is known first.
  struct Step {
    int vertex;
    std::array<int, 4> edges;
    DegreeFourVertex folds;
  };

  int pilot_edge() const { return pilot_edge_; }
  /// +1 valley, -1 mountain, per edge of the sheet; 0 on the perimeter.
  const std::vector<int>& assignment() const { return assignment_; }
  /// +1 where that is +z, -1 where the pilot is a mountain seen from there.
  int side() const { return side_; }
  /// The pilot's largest angle, to 1e-6: 180 if the whole sheet folds flat.
  double end_deg() const { return end_deg_; }

  /// Half fold angles of all edges when the pilot's is `pilot`, up to end_deg.
  std::vector<HalfAngle<double>> fold_angles(const HalfAngle<double>& pilot) const;

  /// All inner vertices, in order from the pilot.
  const std::vector<Step>& steps() const { return steps_; }

 private:
  friend class SequentialMethod;

  // Half fold angles so far, and the vertex that cannot fold that far; -1 if there is none.
  int follow(const HalfAngle<double>& pilot, double closed_rad,
             std::vector<HalfAngle<double>>& angles) const;

  int pilot_edge_ = -1, side_ = 1;
  std::vector<int> assignment_;
  std::vector<Step> steps_;
  double end_deg_ = 0;
};

/// Why a crease pattern has no base folding.
struct NoBaseFolding {
  enum class Cause {
    assignment,  ///< the vertex does not fold with these mountains and valleys
    open,  ///< at `pilot_deg` the vertex gives the crease another fold angle than its other end
    ambiguous,   ///< edges without an assignment can be completed in several ways, at this vertex
    unconnected  ///< the vertex is not reached from the pilot
  } cause;
  int vertex, edge = -1;
  double pilot_deg = 0, angle_deg = 0, other_angle_deg = 0;

  /// Of `assignment`: the vertex' creases counter-clockwise with their signs as seen from +z, 0
  /// where not known; some may follow from what its neighbours need.
  struct Creases {
    std::array<int, 4> edges, signs;
    /// The ones of the four that can differ in sign from the other three; all of them have one such
    /// crease. None: no assignment folds a vertex with these sector angles.
    std::vector<int> odd;
    /// The one whose other sign alone would let the vertex and those next to it fold; or -1.
    int wrong;
  };
  std::optional<Creases> creases{};

  /// The way of folding whose loops are open by far the least next to flat, where the assignment
  /// has one: that of a sheet near this one, maybe (nearest_base.hpp).
  std::optional<BaseFolding> unclosed{};
};

/// Follows the folding from the pilot over all interior vertices (of degree four each) and checks
/// that every crease gets the same angle from both of its ends, from flat to the end. `assignment`
/// per edge as seen from +z, 0 where it is not known (edges of holes): completed if there is one
/// way only.
std::variant<BaseFolding, NoBaseFolding> fold_sequentially(const CreasePattern& sheet,
                                                           const std::vector<int>& assignment,
                                                           int pilot_edge);

}  // namespace misalign::solver
