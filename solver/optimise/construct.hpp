// The study of construction: the sheet of the parallel family with the largest least stroke, by
// linear programs in the family's coordinates.
#pragma once

#include <optional>
#include <vector>

#include "solver/pattern/parallel_family.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

struct ConstructOptions {
  double amplitude_mm = 0.4;     ///< no vertex is shifted by more, in x or in y
  std::optional<double> stroke;  ///< required |L - L0| / L0 at `at_deg`; none: the largest
  double at_deg = 179;           ///< pilot angle of the stroke
  std::vector<int> signs;        ///< per hole, for both delta and epsilon: +1 or -1; empty: chosen
};

struct ConstructStudy {
  /// The change of one hole.
  struct Hole {
    int facet;
    double delta_mm, epsilon_mm;
    int direction;  ///< HoleMotion::direction
    double stroke;  ///< stroke at `at_deg` of the diagonal that changes less
  };

  Eigen::Matrix2Xd shifts_mm;  ///< one column per vertex
  int dimension = 0;           ///< dimension of the family
  std::vector<Hole> holes;
  double stroke = 0;           ///< least stroke of a hole
  double amplitude_mm = 0;     ///< the largest shift of a vertex in x or y
  std::vector<int> binding;    ///< vertices at the largest allowed shift
  double misfit_mm = 0;        ///< parallel_misfit: rounding
  double base_misfit_rad = 0;  ///< ParallelFamily::misfit_rad
  /// Returns whether every diagonal is monotone from flat to 180 degrees, by the closed form.
  bool is_monotone() const;
};

/// Maximises the stroke's rate by the shifts near zero, with equal signs in each hole. Where
/// `options.signs` is empty, several arrangements of signs are tried and the best is taken, not
/// certainly the best of all. Faults: signs whose number is not that of the holes, or that the
/// family does not have; a stroke out of reach; shifts with a facet that is not convex.
StudyResult<ConstructStudy> construct(const PerforatedSheet& base, const ParallelFamily& family,
                                      const ConstructOptions& options);

}  // namespace misalign::solver
