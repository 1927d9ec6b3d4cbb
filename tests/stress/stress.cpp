// The stress suite: sheets of every family at the hard places, each path checked by its own loops,
// by the lengths of its panels, and against dense matrices in small steps. Prints a table.
//   stress          the short form
//   stress --long   the long one, more than 100,000 cases; PART PARTS after it: a share of the rows
// Fails if a path is undecided or on a wrong branch, or a shape is not rigid.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>

#include "bases.hpp"
#include "solver/lanes/batch.hpp"
#include "witnesses.hpp"

namespace misalign::stress {
namespace {

using solver::ShiftBlock;

// One row of the table.
struct Setting {
  std::string place, name;
  std::function<solver::PerforatedSheet()> base;
  solver::PathPlanOptions path;
  double share;  // of the largest amplitude that cannot spoil a facet; ternary
  int short_cases, long_cases;
  bool against_dense = true;
};

struct Row {
  int cases = 0, undecided = 0, wrong = 0, to_the_end = 0, dense_failed = 0, at_band = 0;
  double residual = 0, isometry_mm = 0, length_mm = 0;
};

// Lengths may differ by this between two solvers that closed all loops to 1e-12, or between two
// ways of stepping (panel widths; 80 mm: 1e-9 mm), where the curve is not about to turn.
constexpr double kLengthBand_widths = 1.25e-11;
// Edges and diagonals of panels: the closure tolerance adds up over the panels on the way (400 on
// 20 x 20).
constexpr double kIsometryPerPanel_widths = 1e-12;

ShiftBlock draws(const solver::PerforatedSheet& base, const std::vector<int>& shifted, double share,
                 int sheets, unsigned seed) {
  const double amplitude_mm = share * solver::largest_safe_amplitude_mm(base.sheet, shifted);
  std::mt19937 words(seed);
  ShiftBlock block{std::vector<double>(2 * shifted.size() * static_cast<std::size_t>(sheets)),
                   sheets};
  for (double& shift : block.shifts_mm) {
    shift = amplitude_mm * (static_cast<int>(words() % 3) - 1);
  }
  return block;
}

// Whether two verdicts on the same lengths differ because a step or a variation is as large as the
// verdict's own band, which rounding then decides (sheets 100 panel widths long: 2e-13 of the
// band's 1e-12).
bool at_a_band(const Verdict& a, const Verdict& b, double length_error) {
  const auto is_of_lengths = [](const Verdict& v) {
    return v.first_fault == solver::Fault::not_monotone ||
           v.first_fault == solver::Fault::inactive_diagonal;
  };
  return is_of_lengths(a) && is_of_lengths(b) && length_error <= solver::kStepBand_widths;
}

bool same(const Verdict& a, const Verdict& b) {
  return a.deploys_from_sample == b.deploys_from_sample && a.first_fault == b.first_fault &&
         a.where == b.where;
}

Row run(const Setting& setting, int cases, unsigned seed) {
  const solver::PerforatedSheet base = setting.base();
  solver::PathPlanOptions path = setting.path;
  path.end_deg = std::min(path.end_deg, base.folding.end_deg());
  const std::vector<int> shifted = solver::interior_vertices(base.sheet);
  const Model model(base, shifted, path, 1);
  const auto batch = solver::make_batch(solver::available_instruction_sets().back(), model);
  // What the fast tests reject must not deploy from their threshold.
  std::vector<std::unique_ptr<Model>> thresholds;
  std::vector<std::unique_ptr<solver::Batch>> batches;
  for (const double part : {0.3, 0.7, 0.85, 0.95}) {
    if (!setting.against_dense) break;
    const int sample = static_cast<int>(part * path.end_deg / path.sample_deg);
    if (sample < 2) continue;
    thresholds.push_back(std::make_unique<Model>(base, shifted, path, sample));
    batches.push_back(
        solver::make_batch(solver::available_instruction_sets().back(), *thresholds.back()));
  }
  const int kept = base.sheet.facet_count() - static_cast<int>(base.holes.size());
  DensePath dense(model, model.path());
  CurvePath curve(model, model.path());
  Row row;
  FlatVertices vertices_mm;
  constexpr int kAtOnce = 64;
  for (int first = 0; first < cases; first += kAtOnce) {
    const ShiftBlock block =
        draws(base, shifted, setting.share, std::min(kAtOnce, cases - first), seed + first);
    const std::vector<Verdict> verdicts = batch->judge(block);
    const std::vector<solver::FoldingHistory>& histories = batch->record(block);
    for (std::size_t k = 0; k < batches.size(); ++k) {
      const auto& rejections = batches[k]->reject(block);
      for (int i = 0; i < block.sheets; ++i) {
        const bool rejects = rejections[i].fault != solver::Fault::none;
        const bool deploys = verdicts[i].deploys_from_sample >= thresholds[k]->threshold_sample();
        if (!rejects || !deploys) continue;
        ++row.wrong;
        std::fprintf(stderr, "%s, %s, sheet %d of seed %u: a fast test at sample %d rejects D %d\n",
                     setting.place.c_str(), setting.name.c_str(), i, seed + first,
                     rejections[i].sample, verdicts[i].deploys_from_sample);
      }
    }
    for (int i = 0; i < block.sheets; ++i) {
      ++row.cases;
      const solver::FoldingHistory& history = histories[i];
      // What the lanes lose is followed by dense matrices, as in a search.
      const bool lanes_know = verdicts[i].first_fault != solver::Fault::undecided;
      row.undecided += history.verdict.first_fault == solver::Fault::undecided;
      row.to_the_end += history.path.end == solver::PathEnd::end_reached;
      bool wrong = lanes_know && !same(verdicts[i], history.verdict);
      for (std::size_t k = 0; k < history.stations.size(); ++k) {
        row.residual = std::max(row.residual, history.open_by[k]);
        row.isometry_mm = std::max(row.isometry_mm, history.isometry_error_mm[k]);
        wrong = wrong || !(history.isometry_error_mm[k] <=
                           kIsometryPerPanel_widths * kept * base.sheet.panel_width_mm);
      }
      // A sheet without a start next to the base is lost to the dense path by its definition.
      const bool has_path = !history.stations.empty();
      if (setting.against_dense && has_path) {
        model.displace(block.of(i), vertices_mm);
        const LengthsOf lengths(history, base.sheet.panel_width_mm);
        bool agrees = same(dense.judge(vertices_mm, lengths), history.verdict) &&
                      dense.length_error() <= kLengthBand_widths;
        double error = dense.length_error();
        if (!agrees) {
          const Verdict other = curve.judge(vertices_mm, lengths);
          error = curve.length_error();
          agrees = same(other, history.verdict) && error <= kLengthBand_widths;
          row.dense_failed += agrees;
          if (!agrees && at_a_band(other, history.verdict, error)) {
            ++row.at_band;
            agrees = true;
          }
          if (!agrees) {
            std::fprintf(stderr,
                         "%s, %s, sheet %d of seed %u: D %d %s, along its curve D %d %s, "
                         "lengths differ by %.1e\n",
                         setting.place.c_str(), setting.name.c_str(), i, seed + first,
                         history.verdict.deploys_from_sample,
                         solver::fault_name(history.verdict.first_fault), other.deploys_from_sample,
                         solver::fault_name(other.first_fault), error);
          }
        }
        row.length_mm = std::max(row.length_mm, error * base.sheet.panel_width_mm);
        wrong = wrong || !agrees;
      }
      row.wrong += wrong;
    }
  }
  return row;
}

// Turning points: from the first sample over the turn down the other half and all the way back.
struct TurnRow {
  int cases = 0, wrong = 0;
  double limit_deg = 0, return_rad = 0;
};

TurnRow run_turns(const solver::PerforatedSheet& base, double share, int cases, unsigned seed) {
  const std::vector<int> shifted = solver::interior_vertices(base.sheet);
  const Model model(base, shifted, {}, 1);
  const auto batch = solver::make_batch(solver::available_instruction_sets().back(), model);
  const solver::Mechanism& mechanism = model.mechanism();
  TurnRow row;
  for (unsigned next = seed; row.cases < cases && next < seed + 100; ++next) {
    const ShiftBlock block = draws(base, shifted, share, 64, next);
    const auto& histories = batch->record(block);
    for (int i = 0; i < block.sheets && row.cases < cases; ++i) {
      // At 180 degrees a path ends whether the curve turns there or not.
      if (histories[i].path.end != solver::PathEnd::fold_limit || histories[i].stations.empty() ||
          histories[i].path.fold_limit_deg > 179.9) {
        continue;
      }
      ++row.cases;
      FlatVertices vertices_mm;
      model.displace(block.of(i), vertices_mm);
      solver::SheetGeometry<double> geometry;
      solver::place(mechanism, vertices_mm, geometry);
      solver::FoldState<double> start = model.path().start;
      solver::Newton newton(mechanism);
      newton.correct(geometry, start);
      newton.correct(geometry, start);  // to rounding: a closure of 1e-12 leaves 4e-9 next to flat
      Curve curve(mechanism, geometry, start);
      constexpr double kStep_rad = 0.03;
      const double limit_deg = curve.walk_to_turn(kStep_rad);
      const double error_deg = std::abs(limit_deg - histories[i].path.fold_limit_deg);
      // Some way down the other half, and all the way back over the turn.
      bool good = error_deg < 1e-6;
      for (int k = 0; k < 60 && good; ++k) good = curve.step(kStep_rad);
      curve.reverse();
      for (int k = 0; good && !(curve.pilot_deg() < 1 && curve.pilot_rate() < 0); ++k) {
        good = k < 20000 &&
               curve.step(std::min(kStep_rad, 0.5 * curve.pilot_deg() * solver::kRadPerDeg));
      }
      solver::FoldState<double> back = curve.state();
      back.creases[mechanism.pilot] = start.creases[mechanism.pilot];
      for (int k = 0; k < 2; ++k) newton.correct(geometry, back);
      const double apart_rad = 2 * solver::largest_half_sine(back, start);
      row.limit_deg = std::max(row.limit_deg, error_deg);
      row.return_rad = std::max(row.return_rad, apart_rad);
      if (!good || !(apart_rad <= 1e-10)) {
        ++row.wrong;
        std::fprintf(stderr, "turn: case %d of seed %u: limit off by %.1e deg, back off by %.1e\n",
                     i, next, error_deg, apart_rad);
      }
    }
  }
  return row;
}

// The share of its safe amplitude that 0.4 mm is on the paper's sheet.
constexpr double kPaperShare = 0.025;

std::vector<Setting> settings() {
  using solver::PathPlanOptions;
  std::vector<Setting> all;
  const auto paper66 = [] { return paper(6, 6, "checkerboard-odd"); };
  const std::vector<std::pair<std::string, std::function<solver::PerforatedSheet(int, int)>>>
      families = {{"Miura, odd", [](int m, int n) { return paper(m, n, "checkerboard-odd"); }},
                  {"Miura, even", [](int m, int n) { return paper(m, n, "checkerboard-even"); }},
                  {"Miura, wide", [](int m, int n) { return miura(m, n, 70, 200); }},
                  {"Miura, narrow", [](int m, int n) { return miura(m, n, 50, 40); }},
                  {"Miura, graded", graded},
                  {"double corrugation", double_corrugation},
                  {"angle array", [](int m, int n) { return turned_quads(m, n, 110, 100, 80); }},
                  {"turned quads", [](int m, int n) { return turned_quads(m, n, 104, 100, 84); }}};
  // Odd sides leave one degree of freedom where no two creases are collinear.
  for (const auto& [m, n] : {std::pair(5, 6), {7, 6}}) {
    all.push_back({"family and size",
                   "angle array " + std::to_string(m) + " x " + std::to_string(n),
                   [m = m, n = n] { return turned_quads(m, n, 110, 100, 80); },
                   {},
                   kPaperShare,
                   4,
                   1000});
  }
  for (const auto& [name, make] : families) {
    for (const auto& [m, n, few, many] : {std::tuple(4, 4, 32, 2000),
                                          {6, 6, 16, 4000},
                                          {8, 6, 4, 500},
                                          {8, 8, 4, 200},
                                          {10, 10, 2, 40}}) {
      all.push_back({"family and size",
                     name + " " + std::to_string(m) + " x " + std::to_string(n),
                     [=, make = make] { return make(m, n); },
                     {},
                     kPaperShare,
                     few,
                     many});
    }
  }
  for (const int n : {20, 28, 40}) {
    for (const auto& [name, make] : {families[0], families[5]}) {
      all.push_back({"large sheets",
                     name + " " + std::to_string(n) + " x " + std::to_string(n),
                     [=, make = make] { return make(n, n); },
                     {},
                     kPaperShare,
                     0,
                     n == 40 ? 2 : 8,
                     false});
    }
  }
  for (const double deg : {0.5, 1.0, 5.0, 20.0, 45.0, 75.0, 85.0, 89.0, 89.5}) {
    char name[40];
    std::snprintf(name, sizeof name, "sector angle %g deg", deg);
    all.push_back(
        {"sector angle", name, [=] { return miura(6, 6, deg); }, {}, kPaperShare, 8, 2000});
  }
  for (const auto& [sample_deg, end_deg, few, many] : {std::tuple(0.01, 5.0, 4, 1000),
                                                       {0.1, 180.0, 2, 400},
                                                       {0.3, 180.0, 2, 500},
                                                       {3.0, 180.0, 8, 2000},
                                                       {5.0, 180.0, 8, 2000},
                                                       {10.0, 180.0, 8, 2000},
                                                       {20.0, 180.0, 8, 2000}}) {
    PathPlanOptions path;
    path.sample_deg = sample_deg;
    path.end_deg = end_deg;
    char name[60];
    std::snprintf(name, sizeof name, "samples of %g deg to %g", sample_deg, end_deg);
    all.push_back({"start and samples", name, paper66, path, kPaperShare, few, many});
  }
  for (const double share : {1e-10, 1e-7, 1e-5, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95}) {
    char name[40];
    std::snprintf(name, sizeof name, "%.0e of the safe amplitude", share);
    all.push_back({"amplitude", name, paper66, {}, share, 8, 2000});
    if (share <= 1e-3) {
      std::snprintf(name, sizeof name, "%.0e, angle array", share);
      all.push_back(
          {"amplitude", name, [] { return turned_quads(6, 6, 110, 100, 80); }, {}, share, 4, 1000});
    }
  }
  for (const double below : {1e-2, 1e-4, 1e-6, 0.0}) {
    PathPlanOptions path;
    path.end_deg = 180 - below;
    for (const double share : {1e-7, 1e-4, 2e-3}) {
      char name[60];
      std::snprintf(name, sizeof name, "end 180 - %g deg, %.0e", below, share);
      all.push_back({"next to 180 deg", name, paper66, path, share, 4, 1000});
    }
  }
  return all;
}

int run_all(bool is_long, int part, int parts) {
  bool good = true;
  long cases = 0, undecided = 0, wrong = 0;
  std::printf(
      "| place | sheets | cases | to the end | worst residual | worst panel error, mm | worst "
      "length "
      "against dense, mm | dense jumped or had no start | at a band | undecided | wrong "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  int number = 0;
  for (const Setting& setting : settings()) {
    const int wanted = is_long ? setting.long_cases : setting.short_cases;
    if (number++ % parts != part || wanted == 0) continue;
    const Row row = run(setting, wanted, 20150235);
    std::printf("| %s | %s | %d | %d | %.1e | %.1e | %.1e | %d | %d | %d | %d |\n",
                setting.place.c_str(), setting.name.c_str(), row.cases, row.to_the_end,
                row.residual, row.isometry_mm, row.length_mm, row.dense_failed, row.at_band,
                row.undecided, row.wrong);
    std::fflush(stdout);
    cases += row.cases;
    undecided += row.undecided;
    wrong += row.wrong;
  }
  std::printf(
      "\n| turning points of | cases | worst limit, deg | worst return, rad | wrong "
      "|\n|---|---|---|---|---|\n");
  const std::vector<std::pair<std::string, std::function<solver::PerforatedSheet()>>> turning = {
      {"Miura 4 x 4", [] { return paper(4, 4, "checkerboard-odd"); }},
      {"Miura 6 x 6", [] { return paper(6, 6, "checkerboard-odd"); }},
      {"double corrugation 6 x 6", [] { return double_corrugation(6, 6); }},
      {"angle array 6 x 6", [] { return turned_quads(6, 6, 110, 100, 80); }}};
  for (const auto& [name, make] : turning) {
    if (number++ % parts != part) continue;
    const TurnRow row = run_turns(make(), kPaperShare, is_long ? 200 : 2, 7);
    std::printf("| %s | %d | %.1e | %.1e | %d |\n", name.c_str(), row.cases, row.limit_deg,
                row.return_rad, row.wrong);
    std::fflush(stdout);
    cases += row.cases;
    wrong += row.wrong;
    good = good && row.cases > 0;
  }
  std::printf("\n%ld cases, %ld undecided, %ld wrong\n", cases, undecided, wrong);
  return good && cases > 0 && undecided == 0 && wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace misalign::stress

int main(int argc, char** argv) {
  const bool is_long = argc > 1 && std::strcmp(argv[1], "--long") == 0;
  const int part = argc > 3 ? std::atoi(argv[2]) : 0, parts = argc > 3 ? std::atoi(argv[3]) : 1;
  return misalign::stress::run_all(is_long, part, parts);
}
