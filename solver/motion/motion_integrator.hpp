// Integrates the motion of one coordinate with SUNDIALS' CVODE (Hindmarsh et al., ACM TOMS 31,
// 2005) and locates its events.
#pragma once

#include <functional>
#include <memory>

namespace misalign::solver {

class MotionIntegrator {
 public:
  /// The method of integration: Adams' methods of changing order and step, or backward differences
  /// where strong damping makes the equation stiff: the motion soon creeps slowly, and Adams' steps
  /// would stay short.
  enum class Method { adams, backward_differences };

  struct State {
    double time, x, rate;
  };

  using Acceleration = std::function<double(double x, double rate)>;

  /// The motion stops where x reaches `end` or -`end`. Errors of x and its rate are at most
  /// `tolerance` times `scale` a step.
  MotionIntegrator(Acceleration acceleration, Method method, double end, double scale,
                   double tolerance);
  ~MotionIntegrator();
  MotionIntegrator(const MotionIntegrator&) = delete;
  MotionIntegrator& operator=(const MotionIntegrator&) = delete;

  /// Begins at a state, or continues after a jump of the acceleration.
  void start(const State& state);
  void stop_at(double time);

  enum class Stop { step, at_zero, at_rest, at_end, at_time, failed };
  /// Takes one step, shortened to where x or its rate is zero, or the end or the time is reached.
  Stop step();
  const State& state() const { return state_; }
  /// State within the last step.
  State state_at(double time) const;

 private:
  struct Cvode;
  const std::unique_ptr<Cvode> cvode_;
  State state_{};
};

}  // namespace misalign::solver
