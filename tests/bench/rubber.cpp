// Rubber plates beside membranes of finite elements, and cut-outs chosen for random draws: the
// tables of results/rubber.md.
//   rubber membranes PATTERN...   each with plates of 1 mm, 0.5 MPa, at four pre-stretches
//   rubber draws NUMBER TO_DEG    of so many random draws that fold to 150 degrees, down to an
//   angle rubber release PATTERN        motions of a sheet let go from 36 degrees, as CSV
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>

#include "schema/pattern/pattern_file.hpp"
#include "solver/fitting/cut_outs.hpp"
#include "solver/motion/deploy.hpp"
#include "tests/solver/fill/membrane.hpp"

namespace misalign::bench {
namespace {

using namespace solver;
using Corners = Membrane::Corners;

constexpr double kShear = 0.5;  // N/mm: 1 mm, 0.5 MPa
constexpr unsigned kSeed = 57;

std::array<int, 4> corners_of(const Mechanism& mechanism, int hole) {
  const Diagonal &one = mechanism.diagonals[static_cast<std::size_t>(2 * hole)],
                 &other = mechanism.diagonals[static_cast<std::size_t>(2 * hole + 1)];
  return {one.from, other.from, one.to, other.to};
}

double closed_form(const Corners& rest_mm, const Corners& now_mm) {
  const auto shape_of = [](const Corners& at_mm) {
    const Eigen::Vector3d first = at_mm.col(2) - at_mm.col(0), second = at_mm.col(3) - at_mm.col(1);
    return HoleShape{first.squaredNorm(), second.squaredNorm(), first.dot(second)};
  };
  const HoleShape now = shape_of(now_mm);
  return PlateLaw(kShear, shape_of(rest_mm))
      .at({std::sqrt(now.first_mm2), std::sqrt(now.second_mm2)}, now.product_mm2)
      .n_mm;
}

// Energies of all plates above those of the flat sheet.
struct Energies {
  double flat = 0, closed = 0, relaxed = 0, resolved = 0, unbalanced_n = 0;
};

Energies energies_at(const Sheet& sheet, double stretch, double pilot_deg, bool with_buckles) {
  Energies sum;
  for (int h = 0; h < sheet.mechanism().diagonal_count() / 2; ++h) {
    const auto corners = corners_of(sheet.mechanism(), h);
    Corners flat_mm = Corners::Zero();
    flat_mm.topRows<2>() = sheet.vertices_mm()(Eigen::all, corners);
    const Corners now_mm = sheet.at(pilot_deg).vertices_mm(Eigen::all, corners);
    const Corners rest_mm = flat_mm / stretch;
    const double at_flat = closed_form(rest_mm, flat_mm);  // exact: a similarity
    sum.flat += at_flat;
    sum.closed += closed_form(rest_mm, now_mm) - at_flat;
    const Membrane membrane(kShear, rest_mm.topRows<2>(), Membrane::Wrinkles::relaxed);
    const auto solution = membrane.solve(now_mm);
    sum.relaxed += solution.energy_n_mm - at_flat;
    sum.unbalanced_n = std::max(sum.unbalanced_n, solution.unbalanced_n);
    if (!with_buckles) continue;
    const Membrane buckling(kShear, rest_mm.topRows<2>(), Membrane::Wrinkles::resolved);
    sum.resolved += buckling.solve(now_mm).energy_n_mm - at_flat;
  }
  return sum;
}

void compare_membranes(const std::string& path) {
  const schema::Pattern pattern = schema::read_pattern_file(path);
  const Model model(pattern.base, PathPlanOptions{});
  SheetSolver solver(model);
  const Sheet sheet(solver, pattern.shifts_mm);
  const std::vector<double> angles_deg = {10, 36, 60, 90, 120, 140};
  fmt::print("\n{}, E - E(flat), N mm: closed form, elements\n\n| pre-stretch |", path);
  for (const double deg : angles_deg) fmt::print(" {:g}° |", deg);
  fmt::print(
      " difference, of the largest | of the largest E |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const double stretch : {1.0, 1.02, 1.05, 1.1, 1.2}) {
    fmt::print("| {:g} |", stretch);
    double largest = 0, most = 0, off = 0, unbalanced_n = 0;
    std::string resolved;
    for (const double deg : angles_deg) {
      const Energies sum = energies_at(sheet, stretch, deg, stretch == 1);
      fmt::print(" {:.4g}, {:.4g} |", sum.closed, sum.relaxed);
      largest = std::max(largest, std::abs(sum.relaxed));
      most = std::max(most, sum.flat + sum.relaxed);
      off = std::max(off, std::abs(sum.closed - sum.relaxed));
      unbalanced_n = std::max(unbalanced_n, sum.unbalanced_n);
      resolved += fmt::format(" {:.4g} |", sum.resolved);
    }
    fmt::print(" {:.2g} % | {:.2g} % |\n", 100 * off / largest, 100 * off / most);
    if (stretch == 1) fmt::print("| 1, buckled |{} | |\n", resolved);
    if (unbalanced_n > 1e-3) fmt::print("(a node is off balance by {:.1g} N)\n", unbalanced_n);
    std::fflush(stdout);
  }
}

// Ternary shifts of all interior vertices of the paper's sheet.
void choose_for_draws(int wanted, double to_deg) {
  const schema::Pattern pattern =
      schema::read_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json");
  constexpr double kFrom_deg = 150;
  const Model model(pattern.base, PathPlanOptions{});
  SheetSolver solver(model);
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> ternary(-1, 1);
  const std::vector<int> interior = interior_vertices(pattern.base.sheet);
  std::vector<double> chosen;
  const std::vector<double> stretches = {1, 1.05, 1.11, 1.18, 1.25};
  std::vector<int> driven(stretches.size(), 0);
  int monotone = 0, number = 0;
  for (int draw = 0; number < wanted; ++draw) {
    Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, pattern.base.sheet.vertices_mm.cols());
    for (const int v : interior) {
      for (int axis = 0; axis < 2; ++axis) shifts_mm(axis, v) = 0.4 * ternary(random);
    }
    const Sheet sheet(solver, shifts_mm);
    const FoldingWay* const way = sheet.way();
    if (!way || way->end_deg() < kFrom_deg) continue;
    if (way->over_folded_deg() && *way->over_folded_deg() < kFrom_deg) continue;
    ++number;
    monotone += sheet.deploys_from_deg() >= kFrom_deg;
    RubberPlates plates;
    for (std::size_t s = 0; s < stretches.size(); ++s) {
      plates.prestretch = stretches[s];
      driven[s] += least_drive(*way, plates, kFrom_deg, to_deg).n_mm_per_rad2 > 0;
    }
    CutOutOptions options;
    options.from_deg = kFrom_deg;
    options.to_deg = to_deg;
    const auto choice = choose_cut_outs(sheet, options);
    if (!choice) continue;
    chosen.push_back(choice->least_n_mm_per_rad2);
    fmt::print("{:3} draw {:3}: {:8.4g} N mm/rad^2 at {:g} deg, {} rounds\n", number, draw,
               choice->least_n_mm_per_rad2, choice->at_deg, choice->rounds);
    std::fflush(stdout);
  }
  std::ranges::sort(chosen);
  fmt::print("all diagonals monotone: {} of {}\n", monotone, number);
  for (std::size_t s = 0; s < stretches.size(); ++s) {
    fmt::print("uniform pre-stretch {:g}: {} driven\n", stretches[s], driven[s]);
  }
  fmt::print("chosen cut-outs: {} driven, least {:.4g}, median {:.4g}, most {:.4g} N mm/rad^2\n",
             std::ranges::count_if(chosen, [](double value) { return value > 0; }), chosen.front(),
             chosen[chosen.size() / 2], chosen.back());
}

// Motions of a sheet let go from 36 degrees, as CSV.
void release(const std::string& path) {
  const schema::Pattern pattern = schema::read_pattern_file(path);
  const Model model(pattern.base, PathPlanOptions{});
  SheetSolver solver(model);
  const Sheet sheet(solver, pattern.shifts_mm);
  Springs strong, weak;
  weak.stiffness_n_per_mm = 0.475;
  std::vector<std::pair<std::string, Fill>> fills = {{"springs of 50 N/mm", strong},
                                                     {"springs of 0.475 N/mm", weak}};
  for (const double stretch : {1.0, 1.02, 1.05, 1.1, 1.2}) {
    RubberPlates plates;
    plates.prestretch = stretch;
    fills.emplace_back(fmt::format("plates, pre-stretch {:g}", stretch), plates);
  }
  fmt::print("filling,time_s,pilot_deg,energy_n_mm\n");
  for (const auto& [name, fill] : fills) {
    EnergyModel::Options options;
    options.fill = fill;
    for (const Deployment::Row& row : study_deployment(sheet, options, {}).run.rows) {
      fmt::print("\"{}\",{:.8g},{:.6g},{:.6g}\n", name, row.time_s, row.pilot_deg,
                 row.springs_n_mm);
      if (row.event == Deployment::Event::flat) break;
    }
  }
}

}  // namespace
}  // namespace misalign::bench

int main(int count, char** arguments) {
  const std::string study = count > 1 ? arguments[1] : "";
  if (study == "draws" && count == 4) {
    misalign::bench::choose_for_draws(std::atoi(arguments[2]), std::atof(arguments[3]));
  } else if (study == "membranes") {
    for (int i = 2; i < count; ++i) misalign::bench::compare_membranes(arguments[i]);
  } else if (study == "release" && count == 3) {
    misalign::bench::release(arguments[2]);
  } else {
    fmt::print(
        stderr,
        "rubber membranes PATTERN... | rubber draws NUMBER TO_DEG | rubber release PATTERN\n");
    return 1;
  }
}
