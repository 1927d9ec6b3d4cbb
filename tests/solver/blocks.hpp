// Families of shifted sheets that several tests judge, with draws that need nothing of search/.
#pragma once

#include <random>

#include "solver/lanes/batch.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr int kFewer = 10;  // sanitizers look at memory, not at numbers
#else
inline constexpr int kFewer = 1;
#endif

/// Of every test's draws; the sheets are the same on every machine.
inline constexpr unsigned kSeed = 20150235;

/// Of so many vertices: every coordinate -1, 0 or +1 times the amplitude.
inline ShiftBlock ternary_draws(std::size_t vertices, int sheets, unsigned seed,
                                double amplitude_mm) {
  std::mt19937 words(seed);
  ShiftBlock block{std::vector<double>(2 * vertices * sheets), sheets};
  for (double& shift : block.shifts_mm) {
    shift = amplitude_mm * (static_cast<int>(words() % 3) - 1);
  }
  return block;
}

/// Sheet number `i` of a block: its base with the shifts of these vertices.
inline FlatVertices displaced(FlatVertices vertices_mm, const std::vector<int>& shifted,
                              const ShiftBlock& block, int i) {
  const double* shift = block.of(i);
  for (const int vertex : shifted) {
    vertices_mm.col(vertex) += Eigen::Vector2d(shift[0], shift[1]);
    shift += 2;
  }
  return vertices_mm;
}

enum class Shifted { interior, ring };

struct DrawableSheet : TestSheet {
  DrawableSheet(int rows, int columns, Shifted which = Shifted::interior,
                const std::string& holes = "checkerboard-odd")
      : TestSheet(rows, columns, holes),
        shifted_vertices(which == Shifted::interior ? interior_vertices(base.sheet)
                                                    : ring_vertices(base.sheet)) {}

  Model with_threshold(int sample, const PathPlanOptions& path = {}, double ternary_mm = 0) const {
    return Model(base, shifted_vertices, path, sample, {}, ternary_mm);
  }

  ShiftBlock draws(int sheets, unsigned seed, double amplitude_mm = 0.4) const {
    return ternary_draws(shifted_vertices.size(), sheets, seed, amplitude_mm);
  }
  FlatVertices vertices(const ShiftBlock& block, int i) const {
    return displaced(base.sheet.vertices_mm, shifted_vertices, block, i);
  }

  std::vector<int> shifted_vertices;
};

/// A parameter: so many draws of such a sheet.
struct DrawnSheets {
  int rows, columns;
  Shifted shifted;
  int draws;
};
inline void PrintTo(const DrawnSheets& drawn, std::ostream* out) {
  *out << drawn.rows << "x" << drawn.columns << (drawn.shifted == Shifted::ring ? " ring" : "");
}

/// The sheets of `block` with these numbers, in this order.
inline ShiftBlock chosen_of(const ShiftBlock& block, const std::vector<int>& numbers) {
  ShiftBlock chosen{{}, static_cast<int>(numbers.size())};
  const auto size = block.shifts_mm.size() / static_cast<std::size_t>(block.sheets);
  for (const int i : numbers) {
    chosen.shifts_mm.insert(chosen.shifts_mm.end(), block.of(i), block.of(i) + size);
  }
  return chosen;
}

/// 0, 1, ... one for each sheet.
inline std::vector<int> all_of(const ShiftBlock& block) {
  std::vector<int> numbers;
  for (int i = 0; i < block.sheets; ++i) numbers.push_back(i);
  return numbers;
}

/// "D 170, fold_limit at -1, end 2": everything a verdict says, for comparison and for people.
inline std::string words(const Verdict& verdict) {
  return "D " + std::to_string(verdict.deploys_from_sample) + ", " +
         fault_name(verdict.first_fault) + " at " + std::to_string(verdict.where) + ", end " +
         std::to_string(static_cast<int>(verdict.path_end));
}
inline std::string words(const Rejection& rejection) {
  return std::string(fault_name(rejection.fault)) + " at sample " +
         std::to_string(rejection.sample);
}
template <class Result>
std::vector<std::string> words(const std::vector<Result>& results) {
  std::vector<std::string> all;
  for (const Result& result : results) all.push_back(words(result));
  return all;
}

}  // namespace misalign::solver
