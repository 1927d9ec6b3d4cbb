// One coordinate in motion: SUNDIALS' CVODE (Hindmarsh et al., ACM TOMS 31, 2005), with the places
// where something changes located.
#pragma once

#include <functional>
#include <memory>

namespace misalign::solver {

class MotionIntegrator {
 public:
  /// The method of integration: Adams' methods of changing order and step, or backward differences
  /// where much damping makes the equation stiff: it settles to a slow creep at once, which Adams'
  /// steps would have to follow.
  enum class Method { adams, backward_differences };

  struct State {
    double time, x, rate;
  };

  using Acceleration = std::function<double(double x, double rate)>;

  /// Where x reaches `end` or -`end` it must stop. Errors of x are kept at `tolerance` times
  /// `scale` a step, and so are those of its rate.
  MotionIntegrator(Acceleration acceleration, Method method, double end, double scale,
                   double tolerance);
  ~MotionIntegrator();
  MotionIntegrator(const MotionIntegrator&) = delete;
  MotionIntegrator& operator=(const MotionIntegrator&) = delete;

  /// Begins there, or goes on with an acceleration that has jumped.
  void start(const State& state);
  void stop_at(double time);

  enum class Stop { step, at_zero, at_rest, at_end, at_time, failed };
  /// One step, or less: up to where x is zero, the rate is zero, or the end or the time is reached.
  Stop step();
  const State& state() const { return state_; }
  /// Within the last step.
  State state_at(double time) const;

 private:
  struct Cvode;
  const std::unique_ptr<Cvode> cvode_;
  State state_{};
};

}  // namespace misalign::solver
