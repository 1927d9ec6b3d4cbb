#include "solver/continuation/path_point.hpp"

namespace misalign::solver {

PathPoint::PathPoint(const Mechanism& mechanism)
    : state(flat_state<double>(mechanism)),
      lengths(mechanism.diagonals.size()),
      slopes(mechanism.diagonals.size()) {}

PathPoint::~PathPoint() = default;

}  // namespace misalign::solver
