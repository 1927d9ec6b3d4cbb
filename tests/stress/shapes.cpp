// Shapes Miura sheets to six kinds of surfaces and prints a table: how near they come, and how far
// all diagonals are monotone.
//   shapes PANELS [WIDTHS]    PANELS: 6 or 8; WIDTHS: one radius, in widths of the sheet
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "../solver/blocks.hpp"
#include "solver/shape/shape.hpp"

namespace misalign::solver {
namespace {

// The largest root mean square of distances, in widths of the sheet, that is good.
constexpr double kGood = 5e-5;
// The largest difference of the angle to which diagonals are monotone.
constexpr double kSame_deg = 3;

// Heights R / k^2 cos(k x) cos(k y) with one period on the sheet's width: its curvature is 1 / R.
std::unique_ptr<TargetSurface> egg_box(double radius_mm, double width_mm) {
  constexpr int kHalf = 60;
  const double wave = 2 * std::numbers::pi / width_mm, spacing_mm = 0.75 * width_mm / kHalf;
  Eigen::MatrixXd heights_mm(2 * kHalf + 1, 2 * kHalf + 1);
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int k = -kHalf; k <= kHalf; ++k) {
      heights_mm(i + kHalf, k + kHalf) = std::cos(wave * spacing_mm * k) *
                                         std::cos(wave * spacing_mm * i) /
                                         (radius_mm * wave * wave);
    }
  }
  return height_grid(spacing_mm, heights_mm);
}

struct Wanted {
  const char* surface;
  double widths;
  double from_deg[2];  ///< stowed angle of 6 x 6 and of 8 x 8 panels; 0: the shape alone
};

// A prototype, which shares no code, has all diagonals monotone to these angles.
constexpr Wanted kWanted[] = {{"arch across", 5, {150, 150}},
                              {"arch across", 3, {150, 150}},
                              {"arch across", 1.5, {150, 150}},
                              {"arch along", 5, {123, 118}},
                              {"arch along", 3, {103, 98}},
                              {"arch along", 1.5, {0, 0}},
                              {"dome", 5, {128, 118}},
                              {"dome", 3, {108, 103}},
                              {"dome", 2, {93, 0}},
                              {"dome", 1.5, {0, 0}},
                              {"saddle", 5, {118, 118}},
                              {"saddle", 3, {98, 93}},
                              {"saddle", 1.5, {0, 0}},
                              {"twist", 5, {143, 133}},
                              {"twist", 3, {133, 133}},
                              {"twist", 1.5, {108, 112}},
                              {"field", 5, {148, 150}},
                              {"field", 3, {138, 143}},
                              {"field", 1.5, {123, 128}}};

std::shared_ptr<const TargetSurface> surface_of(const Wanted& wanted, double width_mm) {
  const std::string name = wanted.surface;
  const double radius_mm = wanted.widths * width_mm;
  if (name == "arch across") return cylinder(radius_mm, false);
  if (name == "arch along") return cylinder(radius_mm, true);
  if (name == "dome") return sphere(radius_mm);
  if (name == "saddle") return saddle(radius_mm);
  if (name == "twist") return helicoid(radius_mm);
  return egg_box(radius_mm, width_mm);
}

int run(int panels, double only_widths) {
  const DrawableSheet sheet(panels, panels);
  const Model model(sheet.base, all_vertices(sheet.base.sheet), {}, 0);
  SheetSolver solver(model);
  const double width_mm = panels * sheet.base.sheet.panel_width_mm;
  fmt::print(
      "| target | radius, widths | rms, widths | max, widths | shift, mm | asked to | D | "
      "sheets folded | s |\n|---|---|---|---|---|---|---|---|---|\n");
  int missed = 0;
  for (const Wanted& wanted : kWanted) {
    if (only_widths > 0 && wanted.widths != only_widths) continue;
    ShapeOptions options;
    options.target.surface = surface_of(wanted, width_mm);
    const double from_deg = wanted.from_deg[panels == 8];
    options.kind = from_deg > 0 ? ShapeKind::rest : ShapeKind::free;
    options.from_deg = from_deg > 0 ? from_deg : options.at_deg + 1;
    const auto begin = std::chrono::steady_clock::now();
    const StudyResult<ShapeStudy> study = shape(solver, options);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    if (!study) {
      ++missed;
      continue;
    }
    const bool is_good =
        study->rms_mm <= kGood * width_mm && study->deploys_from_deg >= from_deg - kSame_deg;
    missed += !is_good;
    fmt::print("| {} | {} | {:.1e} | {:.1e} | {:.1f} | {} | {}° | {} | {:.1f} |{}\n",
               wanted.surface, wanted.widths, study->rms_mm / width_mm, study->max_mm / width_mm,
               study->shifts_mm.colwise().norm().maxCoeff(),
               from_deg > 0 ? fmt::format("{}°", from_deg) : "–", study->deploys_from_deg,
               study->evaluations, seconds.count(), is_good ? "" : " missed");
    std::fflush(stdout);
  }
  return missed;
}

}  // namespace
}  // namespace misalign::solver

int main(int count, char** words) {
  return misalign::solver::run(std::atoi(words[1]), count > 2 ? std::atof(words[2]) : 0);
}
