#include "solver/motion/motion_integrator.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>

#include <array>
#include <cassert>
#include <cmath>
#include <new>
#include <utility>

namespace misalign::solver {
namespace {

constexpr int kZero = 0, kRest = 1, kEnd = 2, kEvents = 3;

template <class T>
T* made(T* object) {
  if (!object) throw std::bad_alloc();  // the only way in which SUNDIALS' constructors fail here
  return object;
}

// Silences SUNDIALS (7), which prints messages: step() returns failures.
SUNContext silent_context() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR < 7
  SUNContext_Create(nullptr, &context);
#else
  SUNContext_Create(SUN_COMM_NULL, &context);
  SUNContext_ClearErrHandlers(context);
#endif
  return made(context);
}

void silence([[maybe_unused]] void* cvode) {
#if SUNDIALS_VERSION_MAJOR < 7
  CVodeSetErrFile(cvode, nullptr);
#endif
}

}  // namespace

struct MotionIntegrator::Cvode {
  Cvode(Acceleration how, MotionIntegrator::Method method, double farthest)
      : acceleration(std::move(how)), end(farthest) {
    const bool is_stiff = method == MotionIntegrator::Method::backward_differences;
    y = made(N_VNew_Serial(2, context));
    passed = made(N_VNew_Serial(2, context));
    memory = made(CVodeCreate(is_stiff ? CV_BDF : CV_ADAMS, context));
    iteration =
        made(is_stiff ? SUNNonlinSol_Newton(y, context) : SUNNonlinSol_FixedPoint(y, 0, context));
    if (!is_stiff) return;
    jacobian = made(SUNDenseMatrix(2, 2, context));
    solver = made(SUNLinSol_Dense(y, jacobian, context));
  }
  ~Cvode() {
    SUNNonlinSolFree(iteration);
    CVodeFree(&memory);
    if (solver) SUNLinSolFree(solver);
    if (jacobian) SUNMatDestroy(jacobian);
    N_VDestroy(passed);
    N_VDestroy(y);
    SUNContext_Free(&context);
  }
  Cvode(const Cvode&) = delete;
  Cvode& operator=(const Cvode&) = delete;

  static int rates(double, N_Vector at, N_Vector rates, void* self) {
    const double *const y = N_VGetArrayPointer(at), x = y[0], rate = y[1];
    double* const out = N_VGetArrayPointer(rates);
    out[0] = rate;
    out[1] = static_cast<Cvode*>(self)->acceleration(x, rate);
    return 0;
  }
  static int events(double, N_Vector at, double* values, void* self) {
    const double* const y = N_VGetArrayPointer(at);
    const double end = static_cast<Cvode*>(self)->end;
    values[kZero] = y[0];
    values[kRest] = y[1];
    values[kEnd] = (end - y[0]) * (end + y[0]);
    return 0;
  }

  const Acceleration acceleration;
  const double end;
  SUNContext context = silent_context();
  N_Vector y = nullptr, passed = nullptr;
  void* memory = nullptr;
  SUNNonlinearSolver iteration = nullptr;
  SUNMatrix jacobian = nullptr;  // by finite differences; only for Method::backward_differences
  SUNLinearSolver solver = nullptr;
};

MotionIntegrator::MotionIntegrator(Acceleration acceleration, Method method, double end,
                                   double scale, double tolerance)
    : cvode_(std::make_unique<Cvode>(std::move(acceleration), method, end)) {
  assert(end > 0 && scale > 0 && tolerance > 0);
  void* const memory = cvode_->memory;
  CVodeInit(memory, Cvode::rates, 0, cvode_->y);
  CVodeSStolerances(memory, tolerance, tolerance * scale);
  CVodeSetNonlinearSolver(memory, cvode_->iteration);
  if (cvode_->solver) CVodeSetLinearSolver(memory, cvode_->solver, cvode_->jacobian);
  CVodeSetUserData(memory, cvode_.get());
  silence(memory);
  CVodeRootInit(memory, kEvents, Cvode::events);
  CVodeSetNoInactiveRootWarn(memory);
}

MotionIntegrator::~MotionIntegrator() = default;

void MotionIntegrator::start(const State& state) {
  assert(std::isfinite(state.x) && std::isfinite(state.rate));
  assert(std::abs(state.x) <= cvode_->end);
  state_ = state;
  double* const y = N_VGetArrayPointer(cvode_->y);
  y[0] = state.x;
  y[1] = state.rate;
  CVodeReInit(cvode_->memory, state.time, cvode_->y);
}

void MotionIntegrator::stop_at(double time) { CVodeSetStopTime(cvode_->memory, time); }

MotionIntegrator::Stop MotionIntegrator::step() {
  // The time is beyond any step; only its direction matters.
  const int how = CVode(cvode_->memory, state_.time + 1e30, cvode_->y, &state_.time, CV_ONE_STEP);
  if (how < 0) return Stop::failed;
  const double* const y = N_VGetArrayPointer(cvode_->y);
  state_.x = y[0];
  state_.rate = y[1];
  if (how == CV_TSTOP_RETURN) return Stop::at_time;
  if (how != CV_ROOT_RETURN) return Stop::step;
  std::array<int, kEvents> roots{};
  CVodeGetRootInfo(cvode_->memory, roots.data());
  if (roots[kEnd] != 0) return Stop::at_end;
  if (roots[kRest] != 0) return Stop::at_rest;
  assert(roots[kZero] != 0);
  return Stop::at_zero;
}

MotionIntegrator::State MotionIntegrator::state_at(double time) const {
  if (CVodeGetDky(cvode_->memory, time, 0, cvode_->passed) != CV_SUCCESS) return state_;
  const double* const y = N_VGetArrayPointer(cvode_->passed);
  return {time, y[0], y[1]};
}

}  // namespace misalign::solver
