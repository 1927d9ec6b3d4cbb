// The deployment of a sheet in MuJoCo and by `misalign deploy`, and the friction it overcomes.
// Friction acts on the hinges of the joint tree alone: MuJoCo has none for `connect`.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "schema/exchange/mjcf_export.hpp"
#include "schema/files/output_file.hpp"
#include "search/sheets/folding_model.hpp"
#include "search/sheets/release.hpp"
#include "solver/motion/joint_tree.hpp"
#include "tests/bench/mujoco_run.hpp"
#include "tests/folder.hpp"

namespace misalign::search {

/// In MuJoCo, let go at rest.
inline MujocoRun load(const schema::SimulatedSheet& sheet, double friction_n_mm_per_mm) {
  const Folder folder("mujoco");
  const std::string file = folder.file("deploy.xml");
  schema::MjcfOptions options;
  options.friction_n_mm_per_mm = friction_n_mm_per_mm;
  schema::write_text_file(file, schema::mjcf_model(sheet, options));
  return MujocoRun(file);
}

/// Largest difference of the pilot's angle, as a share of the start's, on the way to flat.
inline double largest_difference(const schema::SimulatedSheet& sheet,
                                 const std::vector<solver::Deployment::Row>& rigid, bool shown) {
  MujocoRun run = load(sheet, 0);
  if (shown) std::printf("   time_s  rigid_deg mujoco_deg springs_n_mm mujoco_n_mm\n");
  double largest = 0, next_deg = sheet.pilot_deg;
  double before_s = 0, before_deg = run.pilot_deg(), before_n_mm = run.spring_energy_n_mm();
  for (const solver::Deployment::Row& row : rigid) {
    if (row.pilot_deg < 0) break;
    while (run.time_s() < row.time_s) {
      before_s = run.time_s(), before_deg = run.pilot_deg(), before_n_mm = run.spring_energy_n_mm();
      run.step();
    }
    const double step_s = run.time_s() - before_s;
    const double share = step_s > 0 ? (row.time_s - before_s) / step_s : 0;
    const double there_deg = before_deg + share * (run.pilot_deg() - before_deg);
    largest = std::max(largest, std::abs(there_deg - row.pilot_deg) / sheet.pilot_deg);
    if (shown && row.pilot_deg <= next_deg + 1e-9) {
      std::printf("%9.5f %10.4f %10.4f %12.6g %11.6g\n", row.time_s, row.pilot_deg, there_deg,
                  row.springs_n_mm, before_n_mm + share * (run.spring_energy_n_mm() - before_n_mm));
      next_deg -= 3;
    }
  }
  return largest;
}

/// Whether it passes flat before it stands still. Friction of constraints lets a held joint creep;
/// what is slower than a thousandth of the way in the time that the sheet takes without any is
/// held.
inline bool gets_flat(MujocoRun& run, double flat_s) {
  run.restart();
  const double start_deg = run.pilot_deg();
  double marked_s = 0, marked_deg = start_deg;
  while (run.pilot_deg() > 0) {
    run.step();
    if (run.time_s() - marked_s < flat_s) continue;
    if (marked_deg - run.pilot_deg() < 1e-3 * start_deg) return false;
    marked_s = run.time_s(), marked_deg = run.pilot_deg();
  }
  return true;
}

/// The least of (E0 - E) / sum of l |rho0 - rho| over the way to flat, where creases turn one way:
/// what the springs have given by then for each of what the tree's hinges have taken. The samples
/// of the history are whole degrees, and the start is one.
inline double critical_by_energy(const schema::SimulatedSheet& sheet,
                                 const solver::FoldingHistory& history,
                                 const solver::Actuation& actuation) {
  const solver::JointTree tree = solver::joint_tree(sheet.mechanism, sheet.panels);
  const auto& energy_n_mm = actuation.energy_n_mm;
  const auto start = static_cast<Eigen::Index>(std::lround(sheet.pilot_deg));  // row k is k degrees
  const auto taken_mm = [&](Eigen::Index row) {
    double sum_mm = 0;
    for (std::size_t i = 0; i < sheet.panels.folds.size(); ++i) {
      if (!tree.crease_is_branch[i]) continue;
      const solver::FoldLine& fold = sheet.panels.folds[i];
      const double length_mm = (sheet.flat_mm.col(fold.a) - sheet.flat_mm.col(fold.b)).norm();
      const auto crease = static_cast<Eigen::Index>(i);
      const double now_deg = row > 0 ? history.fold_angle_deg(row - 1, crease) : 0;
      sum_mm += length_mm * std::abs(history.fold_angle_deg(start - 1, crease) - now_deg) *
                solver::kRadPerDeg;
    }
    return sum_mm;
  };
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index row = 0; row < start; ++row) {
    const double given_n_mm =
        energy_n_mm[static_cast<std::size_t>(start)] - energy_n_mm[static_cast<std::size_t>(row)];
    least = std::min(least, given_n_mm / taken_mm(row));
  }
  return least;
}

}  // namespace misalign::search
