// How the vertices of a campaign's sheets are shifted: each by itself, or all together within the
// base's parallel family.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::solver {
struct CreasePattern;
struct PerforatedSheet;
class ParallelFamily;
}  // namespace misalign::solver

namespace misalign::schema {

enum class ShiftDistribution {
  ternary,  ///< -a, 0, +a
  uniform   ///< on [-a, +a]
};

/// Members of the base's parallel family (solver/pattern/README.md): the family's coordinates are
/// drawn, and the shifts follow from them.
struct ParallelDraws {
  std::shared_ptr<const solver::ParallelFamily> family;  ///< of the shifted vertices; never null
  bool like_signs = true;         ///< delta and epsilon of each hole: monotone by the theorem
  double grid_mm = 0;             ///< shifts are whole multiples of it; 0: as they come
  Eigen::VectorXd steps_mm = {};  ///< of each coordinate, on that grid
};

/// The member initializers are the released defaults: they never change (identity leaves them out).
struct Misalignment {
  std::vector<int> vertices;  ///< ascending
  double amplitude_mm = 0.4;  ///< no vertex is shifted by more along x or y
  ShiftDistribution distribution = ShiftDistribution::ternary;
  std::optional<ParallelDraws> parallel = std::nullopt;  ///< nothing: each by itself
};

/// Reads the part "misalignment" of a campaign with this base; without a panel where the base
/// itself has faults.
Misalignment read_misalignment(ObjectReader reader, const solver::PerforatedSheet& base);

/// Every key of that part.
Json misalignment_json(const Misalignment& misalignment, const solver::CreasePattern& sheet);

}  // namespace misalign::schema
