// Compares verdicts by energy of drawn Miura sheets, and rejections, with those of vertex
// coordinates on paths that dense matrices solve in close steps.
//   energy_verdicts PANELS AMPLITUDE_MM FROM_SAMPLE FRICTION DRAWS STEP_DEG
#include <fmt/format.h>

#include <cstdlib>

#include "../solver/blocks.hpp"
#include "../solver/energy_by_coordinates.hpp"

namespace misalign::solver {
namespace {

constexpr double kRate_n_per_mm = 50;
// A comparison this close to its limit is decided by rounding.
constexpr double kNearest = 1e-9;
// Steps of dense matrices may end beyond a fold limit, or on another branch: where verdicts differ,
// the sheet is judged again in shorter steps, by these factors, of the angle and of its shifts.
constexpr int kShorter[] = {20, 400, 4000};

int run(int panels, double amplitude_mm, int from_sample, double friction, int draws,
        double step_deg) {
  const DrawableSheet sheet(panels, panels);
  Criterion criterion;
  Springs springs;
  springs.stiffness_n_per_mm = kRate_n_per_mm;
  criterion.energy = EnergyCriterion{springs, from_sample, friction, 0};
  const Model model(sheet.base, sheet.shifted_vertices, {}, from_sample, criterion, amplitude_mm);
  const ShiftBlock block = sheet.draws(draws, kSeed, amplitude_mm);
  const auto batch = make_batch(available_instruction_sets().back(), model);
  const std::vector<Verdict> verdicts = batch->judge(block);
  const std::vector<Rejection> rejections = batch->reject(block);
  CoordinateJudge dense(model, kRate_n_per_mm, step_deg);
  int again = 0, differ = 0, near = 0, rejected = 0, wrongly = 0, accepted = 0, undecided = 0;
  for (int i = 0; i < draws; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto is_as = [&](const CoordinateVerdict& other) {
      return verdicts[k].deploys_from_sample == other.deploys_from_sample &&
             verdicts[k].first_fault == other.first_fault;
    };
    CoordinateVerdict right = dense.judge(sheet.vertices(block, i));
    again += !is_as(right);
    for (const int shorter : kShorter) {
      if (is_as(right)) break;
      right = CoordinateJudge(model, kRate_n_per_mm, step_deg / shorter, 16 * shorter)
                  .judge(sheet.vertices(block, i));
    }
    if (right.first_fault == Fault::undecided || verdicts[k].first_fault == Fault::undecided) {
      ++undecided;
      continue;
    }
    const bool is_same = is_as(right);
    accepted += verdicts[k].deploys_from_sample >= from_sample;
    near += !is_same && right.nearest < kNearest;
    if (!is_same && !(right.nearest < kNearest)) {
      ++differ;
      fmt::print("sheet {}: {}, by coordinates {}, nearest {:.1e}\n", i, words(verdicts[k]),
                 words(right.verdict()), right.nearest);
    }
    if (rejections[k].fault == Fault::none) continue;
    ++rejected;
    if (right.deploys_from_sample < from_sample) continue;
    ++wrongly;
    fmt::print("sheet {} is rejected ({})\n", i, words(rejections[k]));
  }
  fmt::print(
      "{0} x {0}, {1} mm, from sample {2}, {3} N mm/mm, {4} draws in steps of {5} deg: {6} "
      "accepted, {7} rejected before their paths, {8} wrongly; {9} verdicts differ, {10} "
      "within {11} of a limit, {12} undecided; {13} were judged again in shorter steps\n",
      panels, amplitude_mm, from_sample, friction, draws, step_deg, accepted, rejected, wrongly,
      differ, near, kNearest, undecided, again);
  return differ + wrongly > 0 ? 1 : 0;
}

}  // namespace
}  // namespace misalign::solver

int main(int, char** argv) {
  return misalign::solver::run(std::atoi(argv[1]), std::atof(argv[2]), std::atoi(argv[3]),
                               std::atof(argv[4]), std::atoi(argv[5]), std::atof(argv[6]));
}
