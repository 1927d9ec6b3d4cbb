// A folded sheet whose panels bend under the filling of its holes, at one place of its way.
//
// The sum over the creases of length times |fold angle| is held at its value on the rigid sheet:
// friction works against that sum, and holding a single crease would matter where panels bend much.
// So a bent sheet "at 36 degrees" has turned its creases as far as the rigid sheet whose pilot is
// at 36.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solver/bending/elastic_sheet.hpp"

namespace misalign::solver {

/// Compliance of a folded sheet, linearised at rigid panels.
struct Compliance {
  double turned_mm;
  Eigen::VectorXd lengths_mm;       ///< one per diagonal
  Eigen::MatrixXd mm_per_n;         ///< C: shortening of each diagonal (rows) per newton in each
  Eigen::MatrixXd saddle_mm_per_n;  ///< q of each panel (rows) per newton in each diagonal
};

/// `folded_mm`: 3 x vertices, panels flat, no crease flat. With x the displacements, J_L those of
/// the diagonals and H the panels' stiffness: C = J_L H^-1 J_L^T with the sum held.
std::optional<Compliance> find_compliance(const ElasticSheet& sheet,
                                          const Eigen::Matrix3Xd& folded_mm);

struct BentState {
  double n_mm = 0;             ///< energy of filling and panels
  Eigen::VectorXd forces_n;    ///< one per diagonal, positive where the filling pulls
  Eigen::VectorXd saddles_mm;  ///< q of each panel

  double largest_saddle_mm() const { return saddles_mm.cwiseAbs().maxCoeff(); }
};

/// Bends panels linearly: forces f = dE/dL of the filling at the lengths L - C f, by Newton's
/// method; of springs f = (1/k + C)^-1 (L - L0), in one step.
BentState bend(const Compliance& compliance, const Filling& filling);

/// Forces of a filling of this stiffness (N/mm) that would be `forces_n` with rigid panels, where
/// panels give way linearly: (1 + K C)^-1 F.
Eigen::VectorXd softened(const Compliance& compliance, const Eigen::MatrixXd& n_per_mm,
                         const Eigen::VectorXd& forces_n);

class HeldStiffness;

/// Follows an equilibrium by continuation while its load changes: a tangent as predictor, Newton's
/// method with exact second derivatives as corrector, steps so short that it stays close, and each
/// of its states a minimum of the energy with the sum held. It never begins anew: other equilibria
/// lie close by, most of all near flat. The forces in the panels' planes are unknowns of their own,
/// as in mixed methods (Magisano, Leonetti & Garcea 2017): those at predicted places, which stretch
/// panels, have nothing of an equilibrium's.
class BentFollower {
 public:
  /// A state in full equilibrium, whatever the displacements.
  struct State : BentState {
    double moment_n = 0;  ///< d energy / d sum: N mm per mm
    Eigen::Matrix3Xd at_mm;
    ElasticSheet::Squares squares_mm2;  // they determine the forces in the panels' planes
  };

  /// Begins with the rigid sheet, whose filling's forces are relieved. `sheet` and `filling` must
  /// outlive this object.
  BentFollower(const ElasticSheet& sheet, const Filling& filling,
               const Eigen::Matrix3Xd& folded_mm);
  ~BentFollower();

  /// Follows to another sum, and at first to the filling's whole forces, both in proportion.
  /// Returns false where the equilibrium ends or loses its stability on the way: it then is lost.
  bool follow(double turned_mm);
  const State& state() const { return state_; }

 private:
  struct Load {
    double turned_mm;
    Eigen::VectorXd relief_n;  // taken off the filling's forces
  };
  bool correct(const Load& load, double moved_mm, State& state);
  double move(const Eigen::VectorXd& displacement, State& state) const;

  const ElasticSheet& sheet_;
  const Filling& filling_;
  const std::vector<int> free_;
  Load load_;
  State state_;
  std::unique_ptr<const HeldStiffness> held_;  // stiffness at the last state, or next to it
};

}  // namespace misalign::solver
