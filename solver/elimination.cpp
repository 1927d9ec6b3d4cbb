#include "solver/elimination.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace misalign::solver {
namespace {

// A pivot is no smaller than this share of the largest entry in its column, at every sample, unless
// no entry is: multipliers stay below its inverse.
constexpr double kPivotThreshold = 0.01;

// The matrix while it is eliminated, at all samples at once: rows of nonzeros.
class ActiveMatrix {
 public:
  ActiveMatrix(const std::vector<JacobianEntry>& entries,
               const std::vector<std::vector<double>>& samples, int equations)
      : rows_(equations), rows_in_(equations + 1) {
    for (std::size_t e = 0; e < entries.size(); ++e) {
      std::vector<double>& values = rows_[entries[e].row][entries[e].column];
      for (const auto& sample : samples) values.push_back(sample[e]);
      rows_in_[entries[e].column].insert(entries[e].row);
    }
  }

  struct Place {
    int row = -1, column = -1;
  };

  // The cheapest pivot among `columns` that is at least `threshold` times the largest entry in its
  // column; of equals the largest. No row if there is none.
  Place choose(const std::vector<int>& columns, double threshold) const {
    Place best;
    std::size_t least_cost = ~std::size_t{0};
    double best_share = 0;
    for (const int column : columns) {
      const auto& candidates = rows_in_[column];
      for (const int row : candidates) {
        const std::size_t cost = (rows_[row].size() - 1) * (candidates.size() - 1);
        if (cost > least_cost) continue;
        const double share = share_of_column(row, column);
        if (share < threshold || (cost == least_cost && share <= best_share)) continue;
        best = {row, column};
        least_cost = cost;
        best_share = share;
      }
    }
    return best;
  }

  // Removes the pivot's row and column; what it adds to the other rows stays.
  void eliminate(const Place& pivot) {
    const auto pivot_row = std::move(rows_[pivot.row]);
    for (const auto& [column, values] : pivot_row) rows_in_[column].erase(pivot.row);
    const std::vector<double>& pivot_values = pivot_row.at(pivot.column);
    for (const int row : rows_in_[pivot.column]) {
      const std::vector<double> factors = std::move(rows_[row].at(pivot.column));
      rows_[row].erase(pivot.column);
      for (const auto& [column, values] : pivot_row) {
        if (column == pivot.column) continue;
        std::vector<double>& target = rows_[row][column];
        target.resize(values.size());
        rows_in_[column].insert(row);
        for (std::size_t s = 0; s < values.size(); ++s) {
          target[s] -= factors[s] / pivot_values[s] * values[s];
        }
      }
    }
    rows_in_[pivot.column].clear();
  }

 private:
  // |entry| over the largest in its column, at the sample where that is least.
  double share_of_column(int row, int column) const {
    const std::vector<double>& values = rows_[row].at(column);
    std::vector<double> largest(values.size(), 0);
    for (const int other : rows_in_[column]) {
      const std::vector<double>& entries = rows_[other].at(column);
      for (std::size_t s = 0; s < entries.size(); ++s) {
        largest[s] = std::max(largest[s], std::abs(entries[s]));
      }
    }
    double share = 1;
    for (std::size_t s = 0; s < values.size(); ++s) {
      share = std::min(share, largest[s] > 0 ? std::abs(values[s]) / largest[s] : 0);
    }
    return share;
  }

  std::vector<std::map<int, std::vector<double>>> rows_;
  std::vector<std::set<int>> rows_in_;  // per column
};

// Nested dissection (George 1973) of the loops by where they lie: unknowns of the left part, of the
// right part, then those that belong to loops of both. Without it the cost grows like the 2.3rd
// power of the unknowns on large sheets, with it like the 1.6th.
class Dissection {
 public:
  Dissection(const Mechanism& mechanism, const std::vector<JacobianEntry>& entries,
             const FlatVertices& vertices_mm)
      : loops_of_(mechanism.unknowns) {
    std::vector<int> loop_of_row(mechanism.equations);
    std::vector<int> all;
    for (const Loop& loop : mechanism.loops) {
      const int index = static_cast<int>(all.size());
      all.push_back(index);
      std::fill_n(loop_of_row.begin() + loop.first_row, loop.rows, index);
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (const Passage& passage : loop.passages) middle += vertices_mm.col(passage.vertex);
      middles_.push_back(middle / static_cast<double>(loop.passages.size()));
    }
    for (const JacobianEntry& entry : entries) {
      loops_of_[entry.column].insert(loop_of_row[entry.row]);
    }
    std::vector<int> unknowns;
    for (int j = 0; j < mechanism.unknowns; ++j) unknowns.push_back(j);
    dissect(all, unknowns);
  }

  /// Columns, a part at a time, in the order of elimination.
  const std::vector<std::vector<int>>& parts() const { return parts_; }

 private:
  // Below this many loops Markowitz' order alone is as good.
  static constexpr std::size_t kUndivided = 24;

  void dissect(std::vector<int> loops, const std::vector<int>& unknowns) {
    if (loops.size() <= kUndivided) {
      parts_.push_back(unknowns);
      return;
    }
    Eigen::AlignedBox2d box;
    for (const int loop : loops) box.extend(middles_[loop]);
    const int along = box.sizes().x() >= box.sizes().y() ? 0 : 1;
    const auto half = loops.begin() + static_cast<std::ptrdiff_t>(loops.size() / 2);
    std::sort(loops.begin(), loops.end(), [&](int a, int b) {
      return std::pair(middles_[a][along], a) < std::pair(middles_[b][along], b);
    });
    const std::set<int> left(loops.begin(), half);
    std::vector<int> in_left, in_right, in_both;
    for (const int unknown : unknowns) {
      const auto& mine = loops_of_[unknown];
      const auto inside =
          std::count_if(mine.begin(), mine.end(), [&](int loop) { return left.contains(loop); });
      const bool all_left = inside == static_cast<std::ptrdiff_t>(mine.size());
      (all_left ? in_left : inside == 0 ? in_right : in_both).push_back(unknown);
    }
    dissect({loops.begin(), half}, in_left);
    dissect({half, loops.end()}, in_right);
    parts_.push_back(in_both);
  }

  std::vector<std::set<int>> loops_of_;  // per unknown
  std::vector<Eigen::Vector2d> middles_;
  std::vector<std::vector<int>> parts_;
};

int sign_of(std::vector<int> permutation) {
  int sign = 1;
  for (int i = 0; i < static_cast<int>(permutation.size()); ++i) {
    while (permutation[i] != i) {
      std::swap(permutation[i], permutation[permutation[i]]);
      sign = -sign;
    }
  }
  return sign;
}

// Rows and columns are in order; gives every nonzero its slot and lists what the numeric
// elimination will do.
void write_program(const std::vector<JacobianEntry>& entries, Elimination& plan) {
  const int n = plan.equations;
  std::vector<int> row_at(n), column_at(n + 1);
  for (int i = 0; i < n; ++i) row_at[plan.row_of[i]] = i;
  for (int i = 0; i <= n; ++i) column_at[plan.column_of[i]] = i;
  constexpr std::int32_t kFilled = -1;
  std::vector<std::map<int, std::int32_t>> slot(n);  // per row: column -> slot
  for (const JacobianEntry& entry : entries) slot[row_at[entry.row]][column_at[entry.column]] = 0;
  for (int i = 0; i < n; ++i) {
    slot[i].try_emplace(i, kFilled);
    for (auto at = slot[i].begin(); at->first < i; ++at) {
      const auto& above = slot[at->first];
      for (auto u = above.upper_bound(at->first); u != above.end(); ++u) {
        slot[i].try_emplace(u->first, kFilled);
      }
    }
    for (auto& [column, place] : slot[i]) {
      if (place == kFilled) plan.fill_slots.push_back(plan.slots);
      place = plan.slots++;
      plan.column.push_back(column);
    }
  }
  for (const JacobianEntry& entry : entries) {
    plan.slot_of_value.push_back(slot[row_at[entry.row]][column_at[entry.column]]);
  }
  const auto end = [](const auto& list) { return static_cast<std::int32_t>(list.size()); };
  for (int k = 0; k < n; ++k) {
    const std::int32_t pivot_slot = slot[k].at(k);
    const std::int32_t row_end = slot[k].rbegin()->second + 1;
    Pivot pivot{
        pivot_slot, {pivot_slot + 1, row_end}, {end(plan.lower_slot), 0}, end(plan.targets)};
    for (int i = k + 1; i < n; ++i) {
      const auto below = slot[i].find(k);
      if (below == slot[i].end()) continue;
      plan.lower_slot.push_back(below->second);
      for (auto u = slot[k].upper_bound(k); u != slot[k].end(); ++u) {
        plan.targets.push_back(slot[i].at(u->first));
      }
    }
    pivot.lower.end = end(plan.lower_slot);
    plan.pivots.push_back(pivot);
  }
}

// Jacobians near the base folding from almost flat to almost closed, misaligned and off the
// solution by a few per cent so that nothing vanishes by symmetry. The generator's sequence is
// fixed by the C++ standard: the same plan on every machine.
std::vector<std::vector<double>> representative_jacobians(const Mechanism& mechanism,
                                                          const BaseFolding& folding,
                                                          const FlatVertices& base_vertices_mm) {
  std::mt19937 generator(1);
  const auto random = [&] { return static_cast<double>(generator()) / 2147483648.0 - 1.0; };
  FlatVertices vertices_mm = base_vertices_mm;
  for (Eigen::Index k = 0; k < vertices_mm.size(); ++k) {
    vertices_mm.data()[k] += 0.005 * mechanism.panel_width_mm * random();
  }
  SheetGeometry<double> geometry;
  place(mechanism, vertices_mm, geometry);
  const std::size_t entries = jacobian_entries(mechanism).size();
  std::vector<double> residual(mechanism.equations), turn(mechanism.unknowns);
  std::vector<std::vector<double>> samples;
  for (const double pilot_deg : {1, 5, 20, 60, 100, 130, 150, 165, 175, 178}) {
    const HalfAngle<double> pilot = half_angle_of_deg(pilot_deg);
    FoldState<double> state = base_state(mechanism, folding, base_vertices_mm, pilot);
    for (double& angle : turn) angle = 0.05 * pilot.s * pilot.c * random();
    advance(mechanism, turn.data(), state);
    evaluate(mechanism, geometry, state, residual.data(), samples.emplace_back(entries).data());
  }
  return samples;
}

// The crease that is far from the pilot and fast near the folded end, where fold angles change like
// the inverse of their tangent ratio.
int partner_of_pilot(const Mechanism& mechanism, const BaseFolding& folding,
                     const FlatVertices& vertices_mm) {
  const auto middle = [&](const Crease& crease) -> Eigen::Vector2d {
    return 0.5 * (vertices_mm.col(crease.a) + vertices_mm.col(crease.b));
  };
  const Crease& pilot = mechanism.creases[mechanism.pilot];
  const auto merit = [&](const Crease& crease) {
    return (middle(crease) - middle(pilot)).norm() / std::abs(folding.tangent_ratio[crease.edge]);
  };
  return std::max_element(mechanism.creases.begin(), mechanism.creases.end(),
                          [&](const Crease& a, const Crease& b) { return merit(a) < merit(b); })
      ->column;
}

}  // namespace

Elimination plan_elimination(const Mechanism& mechanism, const BaseFolding& folding,
                             const FlatVertices& base_vertices_mm) {
  const int n = mechanism.equations;
  const int partner = partner_of_pilot(mechanism, folding, base_vertices_mm);
  const std::vector<JacobianEntry> entries = jacobian_entries(mechanism);
  ActiveMatrix active(entries, representative_jacobians(mechanism, folding, base_vertices_mm), n);
  Elimination plan{};
  plan.equations = n;
  std::vector<bool> row_done(n, false);
  std::vector<int> waiting;  // columns of the parts so far that found no pivot yet
  const auto eliminate_waiting = [&](double threshold) {
    for (;;) {
      const ActiveMatrix::Place pivot = active.choose(waiting, threshold);
      if (pivot.row < 0) return;
      active.eliminate(pivot);
      plan.row_of.push_back(pivot.row);
      plan.column_of.push_back(pivot.column);
      row_done[pivot.row] = true;
      std::erase(waiting, pivot.column);
    }
  };
  const Dissection dissection(mechanism, entries, base_vertices_mm);
  for (const auto& part : dissection.parts()) {
    for (const int column : part) {
      if (column != partner && column != n) waiting.push_back(column);
    }
    eliminate_waiting(kPivotThreshold);
  }
  for (double threshold = kPivotThreshold; !waiting.empty(); threshold *= 0.1) {
    assert(threshold > 1e-12 && "the mechanism has more than one degree of freedom");
    eliminate_waiting(threshold);
  }
  plan.row_of.push_back(
      static_cast<int>(std::find(row_done.begin(), row_done.end(), false) - row_done.begin()));
  plan.column_of.push_back(partner);
  plan.permutation_sign = sign_of(plan.row_of) * sign_of(plan.column_of);
  plan.column_of.push_back(n);
  write_program(entries, plan);
  return plan;
}

}  // namespace misalign::solver
