#include "tests/bench/work_precision/study.hpp"

#include <cmath>
#include <cstdio>

#include "schema/campaign/campaign_file.hpp"
#include "tests/bench/work_precision/clock.hpp"
#include "tests/bench/work_precision/methods.hpp"
#include "tests/bench/work_precision/truth.hpp"

namespace misalign::bench {
namespace {

// A path that ends this far from the truth, a hundredth of a panel width, ended elsewhere: on
// another branch of the curve.
constexpr double kElsewhere_mm = 0.8;

constexpr int kFirstExponent = 3, kLastExponent = 14;  // tolerances 1e-3 to 1e-14

struct Trial {
  const Method* method;
  Demand demand;
  Run run;
  std::vector<Track> tracks;
  std::vector<double> times_us;
};

std::vector<Trial> all_trials(const std::vector<Method>& methods, const Problem& problem) {
  std::vector<Trial> trials;
  for (const int spacing_deg : {1, 10}) {
    for (const Method& method : methods) {
      if (std::find(method.spacings_deg.begin(), method.spacings_deg.end(), spacing_deg) ==
          method.spacings_deg.end()) {
        continue;
      }
      for (int exponent = kFirstExponent; exponent <= kLastExponent; ++exponent) {
        const double tolerance = std::pow(10.0, -exponent);
        if (tolerance < 0.9 * method.least_tolerance) break;
        const Demand demand{tolerance, spacing_deg};
        trials.push_back({&method,
                          demand,
                          method.prepare(problem, demand),
                          std::vector<Track>(problem.sheets().size()),
                          {}});
      }
    }
  }
  return trials;
}

void print(const Trial& trial, const Problem& problem, const Truth& truth) {
  const std::size_t samples = static_cast<std::size_t>(kEnd_deg / trial.demand.spacing_deg);
  const std::size_t diagonals = static_cast<std::size_t>(problem.diagonals());
  double largest_mm = 0;
  int not_converged = 0, elsewhere = 0, followed = 0;
  Effort effort;
  for (std::size_t k = 0; k < trial.tracks.size(); ++k) {
    const Track& track = trial.tracks[k];
    effort.corrections += track.effort.corrections;
    effort.evaluations += track.effort.evaluations;
    if (!track.converged || track.lengths.size() != samples * diagonals) {
      ++not_converged;
      continue;
    }
    const int sheet = static_cast<int>(k);
    if (truth.last_error_mm(sheet, track.lengths) > kElsewhere_mm) {
      ++elsewhere;
      continue;
    }
    ++followed;
    largest_mm = std::max(largest_mm,
                          truth.largest_error_mm(sheet, trial.demand.spacing_deg, track.lengths));
  }
  const double paths = static_cast<double>(trial.tracks.size());
  const Method& method = *trial.method;
  std::printf("%d,%s,%s,%s,%s,%s,%g,%.0e,%.1f,", trial.demand.spacing_deg, method.name.c_str(),
              method.linear_solver.c_str(), method.precision.c_str(), method.jacobian.c_str(),
              method.predictor.c_str(), method.step_deg, trial.demand.tolerance,
              median(trial.times_us) / paths);
  if (followed > 0) std::printf("%.3e", largest_mm);
  std::printf(",%.1f,%.1f,%d,%d,%d\n", static_cast<double>(effort.corrections) / paths,
              static_cast<double>(effort.evaluations) / paths, static_cast<int>(paths),
              not_converged, elsewhere);
}

}  // namespace

void measure_methods(int sheets, int repeats) {
  const Problem problem(
      schema::read_campaign_file(MISALIGN_SOURCE_DIR "/search/campaigns/miura-6x6.json"), sheets);
  const Truth truth(problem);
  std::fprintf(stderr, "%d sheets, the last of them draw %d; the truth is open by %.0e\n", sheets,
               static_cast<int>(problem.sheets().back().draw), truth.open_by());

  const std::vector<Method> methods = all_methods();
  std::vector<Trial> trials = all_trials(methods, problem);
  for (Trial& trial : trials) trial.run(trial.tracks);  // warms caches and sizes every buffer
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (Trial& trial : trials) {
      trial.times_us.push_back(elapsed_us([&] { trial.run(trial.tracks); }));
    }
    std::fprintf(stderr, "round %d of %d\n", repeat + 1, repeats);
  }
  std::printf(
      "samples_deg,method,linear_solver,precision,jacobian,predictor,step_deg,tolerance,us_per_"
      "path,"
      "largest_error_mm,corrections_per_path,evaluations_per_path,paths,not_converged,elsewhere\n");
  for (const Trial& trial : trials) print(trial, problem, truth);
}

}  // namespace misalign::bench
