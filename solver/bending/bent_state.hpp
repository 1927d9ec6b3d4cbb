// A folded sheet whose panels bend under the springs on its diagonals, at one place of its way.
//
// What is held is the sum over the creases of length times |fold angle|, at its value on the rigid
// sheet: friction works against that sum, and which single crease is held matters where panels bend
// much. So a bent sheet "at 36 degrees" has turned its creases as far as the rigid one whose pilot
// is at 36.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solver/bending/elastic_sheet.hpp"

namespace misalign::solver {

struct DiagonalSprings {
  double n_per_mm;
  Eigen::VectorXd relaxed_mm;  ///< how long each is without force
};

/// How a folded sheet of rigid panels starts to give.
struct Compliance {
  double turned_mm;
  Eigen::VectorXd lengths_mm;  ///< of the diagonals
  Eigen::MatrixXd mm_per_n;    ///< C: each diagonal's, shorter, for a newton that pulls in each
  Eigen::MatrixXd saddle_mm_per_n;  ///< q of each panel (rows) for a newton in each diagonal
};

/// `folded_mm`: 3 x vertices, panels flat, no crease flat. With x the displacements, J_L those of
/// the diagonals and H the panels' stiffness: C = J_L H^-1 J_L^T with the sum held.
std::optional<Compliance> find_compliance(const ElasticSheet& sheet,
                                          const Eigen::Matrix3Xd& folded_mm);

struct BentState {
  double n_mm = 0;             ///< energy of springs and panels
  Eigen::VectorXd forces_n;    ///< of the springs, positive where they pull
  Eigen::VectorXd saddles_mm;  ///< q of each panel
};

/// To first order: f = (1/k + C)^-1 (L - L0), energy = f . (L - L0) / 2.
BentState bend(const Compliance& compliance, const DiagonalSprings& springs);

class HeldStiffness;

/// Follows an equilibrium by continuation while its load changes: a tangent as predictor, Newton's
/// method with exact second derivatives as corrector, steps so short that it stays close, and each
/// of its states a minimum of the energy with the sum held. Never from a new start: other
/// equilibria lie close by, most of all near flat.
class BentFollower {
 public:
  /// A state in equilibrium to the end, whatever the displacements.
  struct State : BentState {
    double moment_n = 0;  ///< d energy / d sum: N mm per mm
    Eigen::Matrix3Xd at_mm;
  };

  /// At the rigid sheet, which springs do not pull yet. `sheet` must outlive this object.
  BentFollower(const ElasticSheet& sheet, const Eigen::Matrix3Xd& folded_mm, double n_per_mm);
  ~BentFollower();

  /// To another sum and other lengths of the springs without force, both in proportion. False where
  /// the equilibrium ends or loses its stability on the way: it then is lost.
  bool follow(double turned_mm, const Eigen::VectorXd& relaxed_mm);
  const State& state() const { return state_; }

 private:
  struct Load {
    double turned_mm;
    Eigen::VectorXd relaxed_mm;
  };
  bool correct(const Load& load, double moved_mm, State& state);
  double move(const Eigen::VectorXd& by, double share, State& state) const;

  const ElasticSheet& sheet_;
  const double n_per_mm_;
  const std::vector<int> free_;
  Load load_;
  State state_;
  std::unique_ptr<const HeldStiffness> held_;  // of the last correction
};

/// From the rigid sheet, its springs stretched little by little to what they are.
std::optional<BentFollower::State> bend_far(const ElasticSheet& sheet,
                                            const Eigen::Matrix3Xd& folded_mm,
                                            const DiagonalSprings& springs);

}  // namespace misalign::solver
