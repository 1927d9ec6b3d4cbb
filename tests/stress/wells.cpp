// Proves the wells of sheets with springs or plates, and compares them with a sweep: the sheet is
// folded in steps of 0.01 degrees, and its energy is that of vertex coordinates.
//   wells PANELS SHEETS [STEP_DEG]     drawn sheets: springs relaxed at one angle, flat, at two
//                                      angles, preloaded ones, and plates, in turn
//   wells PANELS shapes [STEP_DEG]     sheets shaped to surfaces, relaxed there or flat
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>

#include "../solver/blocks.hpp"
#include "solver/certificate/energy_wells.hpp"
#include "solver/shape/shape.hpp"

namespace misalign::solver {
namespace {

constexpr double kMost_deg = 170;
// Shifts of drawn sheets, in turn.
constexpr double kAmplitudes_mm[] = {0.4, 2, 5};

// The energy of a sheet where its vertices lie, without a filling's code: half the rates times the
// squares of elongations, or the deformation of each hole.
class Energy {
 public:
  Energy(const Sheet& sheet, const Fill& fill) : sheet_(sheet), fill_(fill) {
    const auto* const springs = std::get_if<Springs>(&fill);
    if (!springs) return;
    rests_deg_.assign(diagonals().size(), springs->rest_deg);
    for (const auto& [diagonal, deg] : springs->other_rests_deg) {
      rests_deg_[static_cast<std::size_t>(diagonal)] = deg;
    }
    for (std::size_t d = 0; d < diagonals().size(); ++d) {
      free_mm_.push_back(length_mm(d, rests_deg_[d]));
      if (!springs->preload.is_any()) continue;
      const double side = length_mm(d, 1) > length_mm(d, 0) ? 1 : -1;
      free_mm_[d] -= side * springs->preload.force_n(diagonals()[d]) / springs->stiffness_n_per_mm;
    }
  }

  double n_mm(double pilot_deg) const {
    if (const auto* const plates = std::get_if<RubberPlates>(&fill_))
      return n_mm(*plates, pilot_deg);
    double sum = 0;
    for (std::size_t d = 0; d < free_mm_.size(); ++d) {
      const double longer_mm = length_mm(d, pilot_deg) - free_mm_[d];
      sum += std::get<Springs>(fill_).stiffness_n_per_mm / 2 * longer_mm * longer_mm;
    }
    return sum;
  }

 private:
  const std::vector<Diagonal>& diagonals() const { return sheet_.mechanism().diagonals; }
  Eigen::Vector2d flat_mm(std::size_t d) const {
    return sheet_.point_mm(diagonals()[d].to) - sheet_.point_mm(diagonals()[d].from);
  }
  double length_mm(std::size_t d, double pilot_deg) const {
    if (pilot_deg == 0) return flat_mm(d).norm();
    const Eigen::Matrix3Xd& at_mm = sheet_.at(pilot_deg).vertices_mm;
    return (at_mm.col(diagonals()[d].to) - at_mm.col(diagonals()[d].from)).norm();
  }
  // G t A0 / 2 (I1 + 1 / J^2 - 3) of F = [x y] [x0 y0]^-1, by its entries; the angle between the
  // folded diagonals follows from their constant product.
  double n_mm(const RubberPlates& plates, double pilot_deg) const {
    double sum = 0;
    for (std::size_t d = 0; d < diagonals().size(); d += 2) {
      Eigen::Matrix2d flat, folded;
      flat << flat_mm(d), flat_mm(d + 1);
      const double a = length_mm(d, pilot_deg), b = length_mm(d + 1, pilot_deg);
      const double cosine = flat.col(0).dot(flat.col(1)) / (a * b);
      folded << a, b * cosine, 0, b * std::sqrt(1 - cosine * cosine);
      const Eigen::Matrix2d f = folded * (flat / plates.prestretch).inverse();
      const double area_mm2 = std::abs(flat.determinant()) / 2 / std::pow(plates.prestretch, 2);
      sum += plates.shear_mpa * plates.thickness_mm * area_mm2 / 2 *
             (f.squaredNorm() + std::pow(f.determinant(), -2) - 3);
    }
    return sum;
  }

  const Sheet& sheet_;
  const Fill fill_;
  std::vector<double> rests_deg_, free_mm_;
};

struct Extremum {
  Stationary kind;
  double deg, n_mm;
};

// The steps of a sweep whose energy is below, or above, both neighbours'; flat is 0.
std::vector<Extremum> sweep(const Energy& energy, double to_deg, double step_deg) {
  std::vector<Extremum> found;
  double before = energy.n_mm(0), at = energy.n_mm(step_deg);
  found.push_back({at > before ? Stationary::well : Stationary::top, 0, before});
  for (int k = 2; k * step_deg < to_deg; ++k) {
    const double next = energy.n_mm(k * step_deg);
    if ((at < before) == (at < next)) {
      found.push_back({at < next ? Stationary::well : Stationary::top, (k - 1) * step_deg, at});
    }
    before = at;
    at = next;
  }
  return found;
}

struct Tally {
  int sheets = 0, unproven = 0, stopped = 0, differ = 0;
  std::map<std::size_t, int> by_wells;
  double worst_deg = 0, worst_energy = 0, seconds = 0, proven_deg = 0, asked_deg = 0;
};

// Compares a proof with the sweep; the proof's last step may hold an extremum that the sweep
// misses.
void compare(const Energy& energy, const EnergyWells& wells, double step_deg,
             const std::string& name, Tally& tally) {
  const std::vector<Extremum> seen = sweep(energy, wells.proven_deg, step_deg);
  bool is_same = seen.front().kind == wells.flat;
  std::size_t k = 1;
  for (const StationaryPoint& point : wells.points) {
    const double at_deg = 0.5 * (point.from_deg + point.to_deg);
    if (k == seen.size() && at_deg > wells.proven_deg - 2 * step_deg) break;
    is_same = is_same && k < seen.size() && seen[k].kind == point.kind &&
              std::abs(seen[k].deg - at_deg) <= step_deg + (point.to_deg - point.from_deg) / 2 &&
              point.to_deg - point.from_deg <= 0.01;
    if (!is_same) break;
    tally.worst_deg = std::max(tally.worst_deg, point.to_deg - point.from_deg);
    // Next to its extremum the energy differs by less than a hundredth of a step's second power.
    const double at_n_mm = energy.n_mm(at_deg);
    tally.worst_energy = std::max(tally.worst_energy, std::abs(at_n_mm - point.energy.n_mm) /
                                                          std::max(1.0, energy.n_mm(0) + at_n_mm));
    ++k;
  }
  is_same = is_same && k == seen.size();
  ++tally.by_wells[static_cast<std::size_t>(wells.wells())];
  if (is_same) return;
  ++tally.differ;
  fmt::print("{} differs: proven to {} deg, flat is a {};", name, wells.proven_deg,
             wells.flat ? name_of(*wells.flat) : "?");
  for (const StationaryPoint& point : wells.points) {
    fmt::print(" {} at {:.5f} to {:.5f}", name_of(point.kind), point.from_deg, point.to_deg);
  }
  fmt::print("; swept:");
  for (const Extremum& at : seen) fmt::print(" {} at {:.2f}", name_of(at.kind), at.deg);
  fmt::print("\n");
}

void study(const Sheet& sheet, const Fill& fill, double step_deg, Tally& tally) {
  ++tally.sheets;
  const auto begin = std::chrono::steady_clock::now();
  const double to_deg = std::min(kMost_deg, sheet.way() ? sheet.way()->end_deg() - 0.1 : kMost_deg);
  const StudyResult<EnergyWells> wells = prove_wells(sheet, fill, to_deg);
  tally.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!wells || !wells->flat) {
    ++tally.unproven;
    fmt::print("{}: {}\n", sheet.name(), wells ? name_of(wells->end) : "no proof");
    return;
  }
  tally.asked_deg += to_deg;
  tally.proven_deg += wells->proven_deg;
  tally.stopped += !is_proven(wells->end);
  if (wells->end != CertificateEnd::to_the_end) {
    fmt::print("{}: {} at {:.4f} of {:.4f} deg\n", sheet.name(), name_of(wells->end),
               wells->proven_deg, to_deg);
  }
  compare(Energy(sheet, fill), *wells, step_deg, sheet.name(), tally);
}

// A filling of each kind, in turn.
Fill filling(int number, double end_deg, std::mt19937& random, int diagonals) {
  const auto angle = [&] {
    return std::uniform_real_distribution<double>(5, std::min(kMost_deg, end_deg - 1))(random);
  };
  Springs springs;
  switch (number % 5) {
    case 0:
      springs.rest_deg = angle();
      break;
    case 1:
      break;
    case 2:
      springs.rest_deg = angle();
      for (int d = 0; d < diagonals; d += 2) springs.other_rests_deg.emplace_back(d, angle());
      break;
    case 3:
      springs.preload.each_n = 5;
      break;
    default: {
      RubberPlates plates;
      plates.prestretch = 1.2;
      return plates;
    }
  }
  return springs;
}

void study_draws(int panels, int sheets, double step_deg, Tally& tally) {
  const DrawableSheet drawn(panels, panels);
  const Model model(drawn.base, drawn.shifted_vertices, {}, 0);
  SheetSolver solver(model);
  std::mt19937 random(kSeed);
  for (int i = 0; i < sheets; ++i) {
    const double amplitude_mm = kAmplitudes_mm[(i / 5) % std::size(kAmplitudes_mm)];
    const ShiftBlock block = drawn.draws(1, kSeed + static_cast<unsigned>(i), amplitude_mm);
    const Sheet sheet(solver, drawn.vertices(block, 0) - drawn.base.sheet.vertices_mm,
                      fmt::format("sheet {}", i));
    if (!sheet.way() || sheet.way()->end_deg() < 10) continue;
    study(sheet, filling(i, sheet.way()->end_deg(), random, model.mechanism().diagonal_count()),
          step_deg, tally);
  }
}

void study_shapes(int panels, double step_deg, Tally& tally) {
  const DrawableSheet drawn(panels, panels);
  const Model model(drawn.base, all_vertices(drawn.base.sheet), {}, 0);
  SheetSolver solver(model);
  const double width_mm = panels * drawn.base.sheet.panel_width_mm;
  const std::tuple<const char*, std::shared_ptr<const TargetSurface>, double> wanted[] = {
      {"arch", cylinder(5 * width_mm, false), 150},
      {"dome", sphere(3 * width_mm), 108},
      {"saddle", saddle(5 * width_mm), 118},
      {"twist", helicoid(3 * width_mm), 133}};
  for (const auto& [name, target, from_deg] : wanted) {
    ShapeOptions options;
    options.target.surface = target;
    options.from_deg = from_deg;
    const StudyResult<ShapeStudy> shaped = shape(solver, options);
    if (!shaped) continue;
    Springs springs;
    for (const double rest_deg : {options.at_deg, 0.0}) {
      springs.rest_deg = rest_deg;
      study(Sheet(solver, shaped->shifts_mm, fmt::format("{}, relaxed at {}", name, rest_deg)),
            springs, step_deg, tally);
    }
  }
}

int run(int panels, std::string_view sheets, double step_deg) {
  Tally tally;
  if (sheets == "shapes") {
    study_shapes(panels, step_deg, tally);
  } else {
    study_draws(panels, std::atoi(sheets.data()), step_deg, tally);
  }
  std::string counts;
  for (const auto& [wells, count] : tally.by_wells) counts += fmt::format(" {}: {};", wells, count);
  fmt::print(
      "{0} x {0}: {1} sheets, {2} without a proof, {3} where the proof stops before the end, {4} "
      "differ "
      "from a sweep in steps of {5} deg; wells but flat:{6} {7:.4f} of all angles are proven; "
      "parts "
      "of at most {8:.1e} deg; energies there differ by {9:.1e}; {10:.3f} s a proof\n",
      panels, tally.sheets, tally.unproven, tally.stopped, tally.differ, step_deg, counts,
      tally.proven_deg / tally.asked_deg, tally.worst_deg, tally.worst_energy,
      tally.seconds / tally.sheets);
  return tally.differ;
}

}  // namespace
}  // namespace misalign::solver

int main(int count, char** words) {
  return misalign::solver::run(std::atoi(words[1]), words[2],
                               count > 3 ? std::atof(words[3]) : 0.01);
}
