// Folds the correct (unshifted, unperforated) sheet, from which every path starts, by the
// sequential method: each vertex of degree four gives its other fold angles from one.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "solver/pattern/crease_pattern.hpp"
#include "solver/pattern/degree_four.hpp"
#include "solver/pattern/followed_folding.hpp"

namespace misalign::solver {

/// Largest misfit of loops that count as closed: the difference of the fold angles that a crease
/// gets from its two vertices, as a share of the pilot's. Coordinates written to 1e-4 mm on 80 mm
/// panels leave a tenth of it; the path's Newton steps correct a hundred times as much.
inline constexpr double kBaseClosure = 1e-4;

/// Mountains and valleys are those seen from the side where the pilot is a valley.
class BaseFolding {
 public:
  /// One vertex: its creases counter-clockwise, the one whose angle is known first.
  struct Step {
    int vertex;
    std::array<int, 4> edges;
    DegreeFourVertex folds;
  };

  BaseFolding() = default;
  /// The followed folding of a perforated sheet. `assignment` is per edge as seen from `side`, 0 at
  /// holes; without a `path` only topology is defined.
  BaseFolding(int pilot_edge, int side, std::vector<int> assignment, double end_deg = 0,
              std::shared_ptr<const FollowedFolding> path = nullptr);

  int pilot_edge() const { return pilot_edge_; }
  /// +1 valley, -1 mountain, per edge of the sheet; 0 on the perimeter.
  const std::vector<int>& assignment() const { return assignment_; }
  /// Side from which the pilot is a valley: +1 for +z, else -1.
  int side() const { return side_; }
  /// The pilot's largest angle, to 1e-6: 180 if the whole sheet folds flat.
  double end_deg() const { return end_deg_; }

  /// Half fold angles of all edges when the pilot's is `pilot`, up to end_deg.
  std::vector<HalfAngle<double>> fold_angles(const HalfAngle<double>& pilot) const;

  /// All inner vertices, in order from the pilot; none of a followed folding.
  const std::vector<Step>& steps() const { return steps_; }
  /// The path of a followed folding; null if fold angles have a closed form.
  const FollowedFolding* path() const { return path_.get(); }

 private:
  friend class SequentialMethod;

  // Computes half fold angles; returns the first vertex that cannot fold that far, or -1.
  int follow(const HalfAngle<double>& pilot, double closed_rad,
             std::vector<HalfAngle<double>>& angles) const;

  int pilot_edge_ = -1, side_ = 1;
  std::vector<int> assignment_;
  std::vector<Step> steps_;
  double end_deg_ = 0;
  std::shared_ptr<const FollowedFolding> path_;
};

/// Reason for which a crease pattern has no base folding.
struct NoBaseFolding {
  enum class Cause {
    assignment,  ///< the vertex does not fold with these mountains and valleys
    open,        ///< the crease's two vertices give it different fold angles at `pilot_deg`
    ambiguous,   ///< edges without an assignment can be completed in several ways, at this vertex
    unconnected  ///< the vertex is not reached from the pilot
  } cause;
  int vertex, edge = -1;
  double pilot_deg = 0, angle_deg = 0, other_angle_deg = 0;

  /// The vertex' creases (cause `assignment`), counter-clockwise with their signs as seen from +z,
  /// 0 if unknown; some signs may follow from neighbouring vertices.
  struct Creases {
    std::array<int, 4> edges, signs;
    /// Creases that can differ in sign from the other three, as one must in every assignment. If
    /// empty, no assignment folds a vertex with these sector angles.
    std::vector<int> odd;
    /// The crease whose opposite sign alone would let the vertex and its neighbours fold, or -1.
    int wrong;
  };
  std::optional<Creases> creases{};

  /// The assignment's folding whose loops are by far the least open next to flat, if there is one.
  /// It may be that of a nearby sheet (nearest_base.hpp).
  std::optional<BaseFolding> unclosed{};
};

/// Follows the folding from the pilot over all interior vertices (all of degree four) and checks
/// that both ends of every crease give it the same angle, from flat to the end. `assignment` is per
/// edge as seen from +z, 0 where unknown (edges of holes); it is completed if that can be done in
/// one way only.
std::variant<BaseFolding, NoBaseFolding> fold_sequentially(const CreasePattern& sheet,
                                                           const std::vector<int>& assignment,
                                                           int pilot_edge);

}  // namespace misalign::solver
