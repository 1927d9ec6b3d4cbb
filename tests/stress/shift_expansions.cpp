// Tables of draws to second order, beside the bounds that they claim: against states that Newton's
// method finds at both levels. And how many draws they turn away.
//   shift_expansions DRAWS CAMPAIGN...
#include <fmt/format.h>

#include <algorithm>

#include "../solver/expansion_sums.hpp"
#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/models.hpp"
#include "solver/lanes/expansion_test.hpp"

namespace misalign {
namespace {

using solver::ShiftedQuantity;

// Newton's method from the base folding is the path's state there for these angles; what has not
// converged after two corrections is left out.
constexpr double kConverged_widths = 1e-6;

struct Shares {
  double elongation = 0, slope = 0;  // largest error, of its bound
  int compared = 0, turned_away = 0, above = 0;
};

Shares compare(const schema::Campaign& campaign, const solver::ExpansionTest<double, float>& test,
               const solver::Model& model, int draws) {
  const std::vector<solver::TestPlace> places = {model.test_at(test.early_deg()),
                                                 model.test_at(test.late_deg())};
  solver::LevelSolver<double> solver(model, places);
  const std::size_t diagonals = model.mechanism().diagonals.size();
  std::vector<double> flat(diagonals);
  std::vector<signed char> directions(solver::ShiftExpansion::kDiagonals);
  solver::ShiftBlock block{std::vector<double>(2 * model.shifted().size()), 1};
  Shares shares;
  for (int draw = 0; draw < draws; ++draw) {
    search::draw_shifts(campaign.misalignment, campaign.seed, static_cast<std::uint64_t>(draw),
                        block.shifts_mm.data());
    std::vector<std::vector<solver::ShiftExpansion::Short>> sums;
    bool is_turned_away = false;
    for (int group = 0; group < test.expansion().groups(); ++group) {
      sums.push_back(solver::sums_of(test.expansion(), group, block.shifts_mm.data()));
      is_turned_away |= test.expansion().see(group, sums.back().data(), directions.data());
    }
    shares.turned_away += is_turned_away;
    solver.load(block, 0, 1);
    solver::flat_lengths(model.mechanism(), solver.geometry(), flat.data());
    for (const int place : {0, 1}) {
      solver.solve(place);
      const auto error = solver.length_error(place, 0);
      if (!error || *error > kConverged_widths) continue;
      ++shares.compared;
      for (std::size_t d = 0; d < diagonals; ++d) {
        const double truth = place == 0 ? solver.lengths()[d] - flat[d] : solver.slopes()[d];
        const auto estimate = test.expansion().estimate(
            place == 0 ? ShiftedQuantity::elongation : ShiftedQuantity::slope, static_cast<int>(d),
            sums[d / solver::ShiftExpansion::kDiagonals].data());
        double& share = place == 0 ? shares.elongation : shares.slope;
        const double here = std::abs(estimate.value - truth) / estimate.bound;
        share = std::max(share, here);
        shares.above += here > 1;
      }
    }
  }
  return shares;
}

int run(int draws, const std::vector<std::string>& campaigns) {
  bool is_fine = true;
  for (const std::string& path : campaigns) {
    const schema::Campaign campaign = schema::read_campaign_file(path);
    const solver::Model model = search::model_of(campaign);
    const solver::ExpansionTest<double, float> test(model);
    if (!test.is_there()) {
      fmt::print("{:<24} no tables\n", campaign.name);
      continue;
    }
    const Shares shares = compare(campaign, test, model, draws);
    fmt::print(
        "{:<24} {:>7} states, turned away {:.3f}, largest share of a bound: elongations "
        "{:.2f}, slopes {:.2f}; above {}\n",
        campaign.name, shares.compared, 1.0 * shares.turned_away / draws, shares.elongation,
        shares.slope, shares.above);
    is_fine = is_fine && shares.above == 0 && shares.compared > 1.7 * draws;
  }
  return is_fine ? 0 : 1;
}

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  return misalign::run(std::atoi(argv[1]), {argv + 2, argv + argc});
}
