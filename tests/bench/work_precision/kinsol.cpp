#include "tests/bench/work_precision/kinsol.hpp"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/loop_closure.hpp"
#include "tests/bench/work_precision/scalar.hpp"

namespace misalign::bench {
namespace {

void must(bool done, const char* what) {
  if (!done) throw std::runtime_error(std::string("KINSOL: ") + what);
}

class Kinsol {
 public:
  Kinsol(const Problem& problem, const Demand& demand, const KinsolOptions& options)
      : mechanism_(problem.mechanism()),
        spacing_deg_(demand.spacing_deg),
        start_(problem.base_state(demand.spacing_deg)),
        anchor_(start_),
        state_(start_),
        entries_(solver::jacobian_entries(mechanism_)),
        values_(entries_.size()),
        residual_(static_cast<std::size_t>(mechanism_.equations)),
        step_(static_cast<std::size_t>(mechanism_.unknowns), 0.0),
        lengths_(mechanism_.diagonals.size()) {
    must(SUNContext_Create(nullptr, &context_) == 0, "no context");
    u_ = N_VNew_Serial(mechanism_.equations, context_);
    scale_ = N_VNew_Serial(mechanism_.equations, context_);
    N_VConst(1.0, scale_);
    matrix_ = SUNDenseMatrix(mechanism_.equations, mechanism_.equations, context_);
    linear_ = SUNLinSol_Dense(u_, matrix_, context_);
    memory_ = KINCreate(context_);
    must(memory_ != nullptr, "no memory");
    must(KINInit(memory_, residual_of, u_) == KIN_SUCCESS, "KINInit");
    must(KINSetLinearSolver(memory_, linear_, matrix_) == KIN_SUCCESS, "KINSetLinearSolver");
    if (options.analytic) must(KINSetJacFn(memory_, jacobian_of) == KIN_SUCCESS, "KINSetJacFn");
    must(KINSetUserData(memory_, this) == KIN_SUCCESS, "KINSetUserData");
    must(KINSetErrFile(memory_, nullptr) == KIN_SUCCESS, "KINSetErrFile");
    must(KINSetFuncNormTol(memory_, demand.tolerance) == KIN_SUCCESS, "KINSetFuncNormTol");
    // Out of the way: a small step is no closed loop.
    must(KINSetScaledStepTol(memory_, 1e-30) == KIN_SUCCESS, "KINSetScaledStepTol");
    must(KINSetMaxSetupCalls(memory_, options.steps_a_jacobian) == KIN_SUCCESS,
         "KINSetMaxSetupCalls");
  }
  Kinsol(const Kinsol&) = delete;
  Kinsol& operator=(const Kinsol&) = delete;
  ~Kinsol() {
    KINFree(&memory_);
    SUNLinSolFree(linear_);
    SUNMatDestroy(matrix_);
    N_VDestroy(scale_);
    N_VDestroy(u_);
    SUNContext_Free(&context_);
  }

  void follow(const Sheet& sheet, Track& track) {
    sheet_ = &sheet;
    track.converged = false;
    track.effort = {};
    evaluations_ = 0;
    track.lengths.clear();
    anchor_ = start_;
    for (int pilot_deg = spacing_deg_; pilot_deg <= kEnd_deg; pilot_deg += spacing_deg_) {
      anchor_.creases[mechanism_.pilot] = solver::half_angle_of_deg(pilot_deg);
      N_VConst(0.0, u_);
      const int end = KINSol(memory_, u_, KIN_NONE, scale_, scale_);
      long corrections = 0;
      KINGetNumNonlinSolvIters(memory_, &corrections);
      track.effort.corrections += corrections;
      track.effort.evaluations = evaluations_;
      if (end != KIN_SUCCESS && end != KIN_INITIAL_GUESS_OK) return;
      turn_to(u_);
      std::swap(anchor_, state_);
      solver::folded_lengths(mechanism_, sheet.geometry, anchor_, lengths_.data());
      track.lengths.insert(track.lengths.end(), lengths_.begin(), lengths_.end());
    }
    track.converged = true;
  }

 private:
  void turn_to(N_Vector u) {
    std::copy_n(N_VGetArrayPointer(u), mechanism_.equations, step_.begin());
    state_ = anchor_;
    solver::advance(mechanism_, step_.data(), state_);
  }

  static int residual_of(N_Vector u, N_Vector residual, void* self) {
    Kinsol& kinsol = *static_cast<Kinsol*>(self);
    ++kinsol.evaluations_;
    kinsol.turn_to(u);
    solver::evaluate<double>(kinsol.mechanism_, kinsol.sheet_->geometry, kinsol.state_,
                             N_VGetArrayPointer(residual), nullptr);
    return 0;
  }

  // `evaluate` gives the change by a rotation w that follows the present one. Of the unknown u:
  // w = du / (1 + u^2/4) for a crease, (du + u x du / 2) / (1 + u.u/4) for a ball joint.
  static int jacobian_of(N_Vector u, N_Vector, SUNMatrix jacobian, void* self, N_Vector, N_Vector) {
    Kinsol& kinsol = *static_cast<Kinsol*>(self);
    const solver::Mechanism& mechanism = kinsol.mechanism_;
    ++kinsol.evaluations_;
    kinsol.turn_to(u);
    solver::evaluate<double>(mechanism, kinsol.sheet_->geometry, kinsol.state_,
                             kinsol.residual_.data(), kinsol.values_.data());
    for (std::size_t k = 0; k < kinsol.entries_.size(); ++k) {
      const auto [row, column] = kinsol.entries_[k];
      if (column < mechanism.equations) SM_ELEMENT_D(jacobian, row, column) = kinsol.values_[k];
    }
    const double* at = N_VGetArrayPointer(u);
    for (const solver::Crease& crease : mechanism.creases) {
      if (crease.column == mechanism.equations) continue;
      const double scale = 1 / (1 + 0.25 * at[crease.column] * at[crease.column]);
      double* column = SM_COLUMN_D(jacobian, crease.column);
      for (int row = 0; row < mechanism.equations; ++row) column[row] *= scale;
    }
    for (const solver::BallJoint& ball : mechanism.balls) {
      const solver::Vec3<double> v{0.5 * at[ball.column], 0.5 * at[ball.column + 1],
                                   0.5 * at[ball.column + 2]};
      const double scale = 1 / (1 + dot(v, v));
      double* x = SM_COLUMN_D(jacobian, ball.column);
      double* y = SM_COLUMN_D(jacobian, ball.column + 1);
      double* z = SM_COLUMN_D(jacobian, ball.column + 2);
      for (int row = 0; row < mechanism.equations; ++row) {
        const solver::Vec3<double> j{x[row], y[row], z[row]};
        const solver::Vec3<double> turned = scale * (j + cross(j, v));
        x[row] = turned.x;
        y[row] = turned.y;
        z[row] = turned.z;
      }
    }
    return 0;
  }

  const solver::Mechanism& mechanism_;
  int spacing_deg_;
  solver::FoldState<double> start_, anchor_, state_;
  std::vector<solver::JacobianEntry> entries_;
  std::vector<double> values_, residual_, step_, lengths_;
  const Sheet* sheet_ = nullptr;
  long evaluations_ = 0;
  SUNContext context_ = nullptr;
  N_Vector u_ = nullptr, scale_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  void* memory_ = nullptr;
};

}  // namespace

Run kinsol_steps(const Problem& problem, const Demand& demand, const KinsolOptions& options) {
  auto kinsol = std::make_shared<Kinsol>(problem, demand, options);
  return [kinsol, &problem](std::vector<Track>& tracks) {
    for (std::size_t k = 0; k < tracks.size(); ++k) kinsol->follow(problem.sheets()[k], tracks[k]);
  };
}

}  // namespace misalign::bench
