// Defines the shifts of a campaign's vertices: independent, or within the base's parallel family.
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
  uniform   ///< uniform on [-a, +a]
};

/// Draws of the base's parallel family (solver/pattern/README.md): its coordinates are drawn, and
/// the shifts follow from them.
struct ParallelDraws {
  std::shared_ptr<const solver::ParallelFamily> family;  ///< family of the vertices; never null
  bool like_signs = true;         ///< delta and epsilon of each hole: monotone by the theorem
  double grid_mm = 0;             ///< shifts are whole multiples of it; 0: no grid
  Eigen::VectorXd steps_mm = {};  ///< step of each coordinate on that grid
};

/// The shifts of a campaign. The member initializers are released defaults and never change
/// (identity leaves them out).
struct Misalignment {
  std::vector<int> vertices;  ///< ascending
  double amplitude_mm = 0.4;  ///< largest shift of a vertex along x or y
  ShiftDistribution distribution = ShiftDistribution::ternary;
  std::optional<ParallelDraws> parallel = std::nullopt;  ///< none: independent shifts
};

/// Reads the part "misalignment" of a campaign with this base, which has no panels if it has
/// faults.
Misalignment read_misalignment(ObjectReader reader, const solver::PerforatedSheet& base);

/// Returns every key of that part.
Json misalignment_json(const Misalignment& misalignment, const solver::CreasePattern& sheet);

}  // namespace misalign::schema
