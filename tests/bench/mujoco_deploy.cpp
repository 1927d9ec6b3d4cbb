// Sheets let go in MuJoCo and by `misalign deploy`: time, energy and critical friction beside each
// other.
//
//   mujoco_deploy [--short] FILE DRAW...        draws of a catalogue's campaign
//   mujoco_deploy [--short] PATTERN             a pattern file
//
// Friction acts on the hinges of the joint tree alone, in both: MuJoCo has none for `connect`. Exit
// code 6 where angles over time differ by more than 1 %, or critical frictions by more than 3 %.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/studies.hpp"
#include "tests/bench/mujoco_comparison.hpp"

namespace misalign::search {
namespace {

constexpr double kMostOfAngle = 0.01, kMostOfFriction = 0.03;
constexpr double kFrom_deg = 36;

// By halving, to a two-hundredth of itself.
double critical_in_mujoco(const schema::SimulatedSheet& sheet, double expected, double flat_s) {
  const MujocoRun unit = load(sheet, 1);
  MujocoRun run = load(sheet, 1);
  double low = expected / 2, high = expected * 2;
  const auto gets_with = [&](double friction) {
    run.scale_friction(unit, friction);
    return gets_flat(run, flat_s);
  };
  while (!gets_with(low)) high = low, low /= 2;
  while (gets_with(high)) low = high, high *= 2;
  while (high - low > 0.005 * low) {
    const double middle = (low + high) / 2;
    (gets_with(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

bool agree(const Subject& subject, bool is_short) {
  const auto& [sheet, model, folded] = subject;
  SimulationStart options;
  options.from_deg = kFrom_deg;
  const schema::SimulatedSheet released = release(model, folded, options, sheet.name());
  solver::ReleaseOptions deploy;
  deploy.from_deg = kFrom_deg;
  deploy.sheet.springs().stiffness_n_per_mm = sheet.design.springs().stiffness_n_per_mm;
  const solver::DeploymentStudy study = deployed(folded, deploy);
  const double flat_s = study.run.last().time_s;
  const double angle = largest_difference(released, study.run.rows, !is_short);
  const double by_energy = critical_by_energy(
                   released, folded.history(),
                   solver::actuate(folded, sheet.design.actuators(sheet.base.base))),
               in_mujoco = critical_in_mujoco(released, by_energy, flat_s);
  std::printf(
      "%s: flat after %.5f s; angles differ by %.3f %% of the start's at most; critical "
      "friction of the tree's hinges %.5g N mm per mm, in MuJoCo %.5g (%+.2f %%)\n",
      sheet.name().c_str(), flat_s, 100 * angle, by_energy, in_mujoco,
      100 * (in_mujoco / by_energy - 1));
  return angle <= kMostOfAngle && std::abs(in_mujoco / by_energy - 1) <= kMostOfFriction;
}

int run(std::vector<std::string> words) {
  const bool is_short = std::erase(words, "--short") > 0;
  if (words.empty()) {
    std::fputs("mujoco_deploy [--short] FILE DRAW... | PATTERN\n", stderr);
    return 2;
  }
  bool all_agree = true;
  if (words.size() == 1) all_agree = agree(choose_sheet(words[0], {}), is_short);
  for (std::size_t k = 1; k < words.size(); ++k) {
    all_agree = agree(choose_sheet(words[0], std::stoull(words[k])), is_short) && all_agree;
  }
  return all_agree ? 0 : 1;
}

}  // namespace
}  // namespace misalign::search

int main(int argc, char** argv) {
  try {
    return misalign::search::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
