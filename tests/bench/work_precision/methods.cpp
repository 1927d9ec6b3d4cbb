#include "tests/bench/work_precision/methods.hpp"

#include <algorithm>
#include <memory>

#include "solver/lanes/batch.hpp"
#include "tests/bench/work_precision/adaptive.hpp"
#include "tests/bench/work_precision/fixed_steps.hpp"
#include "tests/bench/work_precision/level.hpp"
#include "tests/bench/work_precision/tracking.hpp"
#ifdef MISALIGN_WITH_KINSOL
#include "tests/bench/work_precision/kinsol.hpp"
#endif

namespace misalign::bench {
namespace {

// What rounding leaves open, and a little more.
constexpr double kLeastInDouble = 1e-14;
constexpr double kLeastInSingle = 1e-6;

const std::vector<int> kEverySpacing{1, 10};

const char* name_of(Predictor predictor) {
  switch (predictor) {
    case Predictor::previous:
      return "previous";
    case Predictor::tangent:
      return "tangent";
    case Predictor::hermite:
      return "hermite";
  }
  return "";
}

// A tracker that follows one sheet after another.
template <class Tracker, class Options>
Prepare one_by_one(const Options& options) {
  return [options](const Problem& problem, const Demand& demand) -> Run {
    auto tracker = std::make_shared<Tracker>(problem, demand, options);
    return [tracker, &problem](std::vector<Track>& tracks) {
      for (std::size_t k = 0; k < tracks.size(); ++k) {
        tracker->follow(problem.sheets()[k], tracks[k]);
      }
    };
  };
}

template <class T, class Linear = DenseLinear<T>>
Method fixed(const std::string& name, double step_deg, Predictor predictor,
             const std::vector<int>& spacings_deg, JacobianBy jacobian = JacobianBy::analytic) {
  const bool single = std::is_same_v<T, float>;
  return {name,
          Linear::kName,
          single ? "single" : "double",
          jacobian == JacobianBy::analytic ? "analytic" : "forward differences",
          name_of(predictor),
          step_deg,
          spacings_deg,
          single ? kLeastInSingle : kLeastInDouble,
          one_by_one<FixedSteps<T, Linear>>(FixedStepsOptions{step_deg, predictor, jacobian})};
}

template <class Linear>
Method adaptive(const std::string& name, Predictor predictor,
                const std::vector<int>& spacings_deg) {
  AdaptiveOptions options;
  options.predictor = predictor;
  return {name,         Linear::kName,      "double",
          "analytic",   name_of(predictor), 0,
          spacings_deg, kLeastInDouble,     one_by_one<Adaptive<Linear>>(options)};
}

// One entry for each spacing, because that is its step.
void add_trackers(const std::string& name, const std::string& linear_solver, const Prepare& prepare,
                  std::vector<Method>& methods) {
  for (const int step_deg : {1, 10}) {
    methods.push_back({name + (step_deg == 10 ? "-10deg" : ""),
                       linear_solver,
                       "double",
                       "analytic",
                       "Adams-Bashforth",
                       static_cast<double>(step_deg),
                       {step_deg},
                       kLeastInDouble,
                       prepare});
  }
}

// Its steps are as long as it holds, whatever the samples' spacing.
Method function(const std::string& name, const std::string& linear_solver, const Prepare& prepare) {
  return {name, linear_solver, "double",       "analytic", "polynomial",
          0,    kEverySpacing, kLeastInDouble, prepare};
}

// Its corrections are counted, not repeated until a tolerance is met: one point.
Method level(const std::string& name, const std::string& linear_solver,
             const std::string& precision, const Prepare& prepare) {
  constexpr double kAnyTolerance = 1e-3;
  return {name, linear_solver, precision,     "analytic", "from a level",
          0,    {10},          kAnyTolerance, prepare};
}

#ifdef MISALIGN_X86
bool has_avx512() {
  const auto sets = solver::available_instruction_sets();
  return std::find(sets.begin(), sets.end(), solver::InstructionSet::avx512) != sets.end();
}
#endif

#ifdef MISALIGN_WITH_KINSOL
Method kinsol(const std::string& name, const KinsolOptions& options) {
  return {name,
          "KINSOL dense",
          "double",
          options.analytic ? "analytic" : "its difference quotients",
          "previous",
          1,
          {1},
          kLeastInDouble,
          [options](const Problem& problem, const Demand& demand) {
            return kinsol_steps(problem, demand, options);
          }};
}
#endif

}  // namespace

std::vector<Method> all_methods() {
  using enum Predictor;
  // One more method is one more entry: a tracker of one sheet after another by `one_by_one`, or a
  // Run of its own where several sheets go side by side.
  std::vector<Method> methods{
      fixed<double>("paper", 1, previous, kEverySpacing),
      fixed<double>("paper-fd", 1, previous, kEverySpacing, JacobianBy::forward_differences),
      fixed<float>("paper-float", 1, previous, kEverySpacing),
      fixed<double, EigenSparseLinear>("paper-eigen-sparse", 1, previous, kEverySpacing),
      fixed<double>("tangent", 1, tangent, kEverySpacing),
      fixed<float>("tangent-float", 1, tangent, kEverySpacing),
      fixed<double>("hermite", 1, hermite, kEverySpacing),
      fixed<double, DenseLinear<float>>("hermite-mixed", 1, hermite, kEverySpacing),
      fixed<double, FixedOrderLinear<double>>("paper-sparse", 1, previous, kEverySpacing),
      fixed<double, FixedOrderLinear<double>>("hermite-sparse", 1, hermite, kEverySpacing),
      adaptive<DenseLinear<double>>("adaptive", hermite, kEverySpacing),
      adaptive<FixedOrderLinear<double>>("adaptive-sparse", hermite, kEverySpacing),
      adaptive<DenseLinear<double>>("adaptive-tangent", tangent, {10}),
      fixed<double>("paper-10deg", 10, previous, {10}),
      fixed<double>("tangent-10deg", 10, tangent, {10}),
#ifdef MISALIGN_WITH_KINSOL
      kinsol("kinsol", {.analytic = true}),
      kinsol("kinsol-newton", {.analytic = true, .steps_a_jacobian = 1}),
      kinsol("kinsol-dq", {.analytic = false}),
#endif
  };
  add_trackers("tracker", FixedOrderLinear<double>::kName, track_one_by_one, methods);
  methods.push_back(function("function", FixedOrderLinear<double>::kName, functions_one_by_one));
  methods.push_back(level("level", FixedOrderLinear<double>::kName, "double", levels_one_by_one));
  methods.push_back(
      level("level-float", FixedOrderLinear<double>::kName, "single", levels_in_single_precision));
#ifdef MISALIGN_X86
  if (has_avx512()) {
    add_trackers("lanes", "fixed order in lanes", track_in_lanes, methods);
    methods.push_back(function("function-lanes", "fixed order in lanes", functions_in_lanes));
    methods.push_back(level("level-lanes", "fixed order in lanes", "double", levels_in_lanes));
  }
#endif
  return methods;
}

}  // namespace misalign::bench
