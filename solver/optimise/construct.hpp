// The study of construction: the sheet of the parallel family whose least used diagonal changes
// most, by linear programs in the family's coordinates.
#pragma once

#include <optional>
#include <vector>

#include "solver/pattern/parallel_family.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

struct ConstructOptions {
  double amplitude_mm = 0.4;     ///< no vertex is shifted by more, in x or in y
  std::optional<double> stroke;  ///< least |L - L0| / L0 wanted at `at_deg`; none: the largest
  double at_deg = 179;           ///< pilot angle of the stroke
  std::vector<int> signs;        ///< per hole, of delta and epsilon alike: +1 or -1; empty: found
};

struct ConstructStudy {
  /// The change of one hole.
  struct Hole {
    int facet;
    double delta_mm, epsilon_mm;
    int direction;  ///< HoleMotion::direction
    double stroke;  ///< of the diagonal that changes less, at `at_deg`
  };

  Eigen::Matrix2Xd shifts_mm;  ///< one column per vertex
  int dimension = 0;           ///< of the family
  std::vector<Hole> holes;
  double stroke = 0;           ///< the least of the holes'
  double amplitude_mm = 0;     ///< the largest shift of a vertex in x or y
  std::vector<int> binding;    ///< vertices that are shifted by the most that is allowed
  double misfit_mm = 0;        ///< of parallel_misfit: rounding
  double base_misfit_rad = 0;  ///< ParallelFamily::misfit_rad
  /// Whether every diagonal goes one way from flat to 180 degrees, as the closed form says.
  bool is_monotone() const;
};

/// Of the stroke's rate by the shifts near zero, maximized with signs alike in each hole. Where
/// `options.signs` is empty, several arrangements of signs are tried and the best is taken: not
/// certain to be the best of all. Faults: signs of another number than the holes, or that the
/// family does not have; a stroke out of reach; shifts that take a facet's convexity.
StudyResult<ConstructStudy> construct(const PerforatedSheet& base, const ParallelFamily& family,
                                      const ConstructOptions& options);

}  // namespace misalign::solver
