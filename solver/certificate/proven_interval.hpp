// The checker's proof that an interval of a folding path is one isolated curve of states.
//
// It uses Krawczyk's theorem with a parameter, as path_tube.hpp does, in the interval's
// coordinates, but by arb's models and the pose closure; an interval that is not proven at once is
// cut into subintervals with a tube each. Doubles are guesses only: an inverse, a polynomial,
// radii. With D at least |I - C J| all over the tube of radii r round the polynomial p, and m at
// least |C F(p)|:
//   m + D r < r   one state for every s, J regular; |p - x| is at most e if m + D e < e <= r;
//   m' + D v < v  with m' at least |C d/ds F| along p' instead of x': |p' - x'| is at most v.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/certificate/arb_model.hpp"
#include "solver/certificate/pose_closure.hpp"
#include "solver/model/panels.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::solver {

inline constexpr int kCheckDegree = 8, kCheckJacobianDegree = 3;
using CheckModel = ArbModel<kCheckDegree>;
/// A path before it is proven.
using CheckGuess = Polynomial<kCheckDegree>;

struct ProvenInterval {
  /// s from middle - half to middle + half.
  struct Subinterval {
    double middle, half;
    std::vector<CheckGuess> guess;  ///< one per unknown but the pilot's
    Eigen::VectorXd radius;  ///< one per unknown: radius of the tube in which states are unique
    Eigen::VectorXd error;   ///< largest distance of the path from the guess
    std::vector<CheckModel> cosines, sines;  ///< per crease, of its half angle; scaled by > 0
    std::vector<CheckModel> stretches;       ///< per diagonal: PoseClosure::squared_elongation
    std::vector<CheckModel> slopes;  ///< per diagonal: rate of its squared length; scaled by > 0
  };

  PathInterval interval;
  JointLines lines;
  double sigma, width;         ///< the pilot at s: sigma + width s, or the tangent width s
  ArbNumber from, middle, to;  ///< values of s; within [-1, 1]
  std::vector<Subinterval> subintervals;  ///< ascending, each from the end of the one before

  /// The unknowns at an s, the pilot's last; undefined where that is not within a subinterval.
  std::vector<ArbNumber> unknowns_at(const ArbNumber& s) const;
};

/// tan(angle / 2), by arb.
ArbNumber half_tangent(const ArbNumber& angle_deg);

class IntervalProver {
 public:
  using Subinterval = ProvenInterval::Subinterval;
  /// Joints in numbers that do not depend on an interval: half a crease's angle, a ball's
  /// quaternion, each times any number.
  struct JointPlaces {
    std::vector<std::array<ArbNumber, 2>> creases;
    std::vector<std::array<ArbNumber, 4>> balls;
  };

  /// Both must outlive this object.
  IntervalProver(const Mechanism& mechanism, const FlatVertices& vertices_mm);

  /// A further claim to prove on each subinterval of an interval; where it is unclear shorter
  /// subintervals are tried.
  using Question = std::function<Proof(const ProvenInterval&, const Subinterval&)>;
  /// Returns unclear where no curve is proven, or not that it is alone within the interval's box.
  Proof prove(const PathInterval& interval, const Question& question, ProvenInterval& proven);

  /// Corners of panels all over a subinterval, from PoseClosure::place_panels.
  std::vector<std::array<std::array<CheckModel, 3>, 4>> place_panels(const ProvenInterval& interval,
                                                                     const Subinterval& subinterval,
                                                                     const FoldedShape& shape,
                                                                     const Panels& panels) const;

  /// The vector of a diagonal, or of its spring, in the flat sheet; panel widths.
  std::array<ArbNumber, 2> flat_diagonal(const Diagonal& diagonal) const;

  JointPlaces places(const ProvenInterval& interval, const std::vector<ArbNumber>& unknowns,
                     const ArbNumber& tau) const;
  std::vector<ArbNumber> unknowns(const ProvenInterval& interval, const JointPlaces& places,
                                  const ArbNumber& tau) const;

 private:
  void begin(ProvenInterval& interval) const;
  void begin_joints(ProvenInterval& interval, const HalfAngle<double>& pilot) const;
  Proof cover(ProvenInterval& interval, double low, double high, const Eigen::VectorXd& start,
              int depth, const Question& question);
  bool prove_subinterval(const ProvenInterval& interval, const Eigen::VectorXd& start,
                         Subinterval& subinterval);
  bool find_middle(const ProvenInterval& interval, Eigen::VectorXd x, Subinterval& subinterval);
  void find_guess(const ProvenInterval& interval, Subinterval& subinterval) const;
  std::vector<ArbNumber> preconditioned(const std::vector<CheckModel>& residual) const;
  void find_deviation(const ProvenInterval& interval, const Subinterval& subinterval);
  bool is_mapped_inside(const std::vector<ArbNumber>& misfit, const Eigen::VectorXd& radii) const;
  Eigen::VectorXd fixed_point(const std::vector<ArbNumber>& misfit) const;
  bool enclose(const ProvenInterval& interval, Subinterval& subinterval);
  bool find_slopes(const ProvenInterval& interval, Subinterval& subinterval);

  const Mechanism& mechanism_;
  SheetGeometry<double> geometry_;
  SheetGeometry<ArbNumber> arb_geometry_;
  Eigen::VectorXd weights_;  // weights of radii on the last subinterval
  Eigen::MatrixXd inverse_, deviation_guess_;
  std::vector<ArbNumber> arb_inverse_, deviation_;  // row by row
};

}  // namespace misalign::solver
