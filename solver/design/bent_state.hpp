// A folded sheet whose panels bend under the springs on its diagonals, at one place of its way.
//
// What is held is the sum over the creases of length times |fold angle|, at its value on the rigid
// sheet: friction works against that sum, and which single crease is held matters where panels bend
// much. So a bent sheet "at 36 degrees" has turned its creases as far as the rigid one whose pilot
// is at 36.
#pragma once

#include <optional>

#include "solver/design/elastic_sheet.hpp"

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

struct BendOptions {
  int most_steps = 60;
  double step_widths = 1e-10;    ///< the last correction's largest displacement
  double longest_widths = 0.05;  ///< of a correction
};

/// To the end, by Newton's method on the vertices with exact second derivatives.
struct FarBentState : BentState {
  bool has_converged = false;
  bool is_stable = false;  ///< a minimum of the energy with the sum held
  int steps = 0;
  double moment_n = 0;  ///< d energy / d sum: N mm per mm
  Eigen::Matrix3Xd at_mm;
};

/// From the shape `start_mm`, whose sum need not be `turned_mm` yet.
FarBentState bend_far(const ElasticSheet& sheet, const Eigen::Matrix3Xd& start_mm, double turned_mm,
                      const DiagonalSprings& springs, const BendOptions& options = {});

}  // namespace misalign::solver
