// Folds the sheet of the paper's Table 1 as far as it goes. Prints the angle D up to which every
// diagonal is monotone, and each diagonal's length when flat and at D.
#include <cstdio>
#include <variant>

#include "solver/pattern/miura.hpp"
#include "solver/records/record_sheet.hpp"

using namespace misalign::solver;

int main() {
  // 6 x 6 panels of 80 mm; every second one of the inner sixteen is taken out.
  const MiuraShape shape = MiuraShape::uniform(6, 6, 80, 80, 40);
  PerforatedSheet base{miura_sheet(shape), {}, {}};
  base.holes = checkerboard(base.sheet, 1);
  base.folding = std::get<BaseFolding>(fold_sequentially(
      base.sheet, miura_assignment(shape, base.sheet), default_pilot(base.sheet, base.holes)));

  FlatVertices vertices_mm = base.sheet.vertices_mm;
  const double table_1[][3] = {{10, .4, 0},    {11, -.4, .4},  {12, -.4, -.4}, {13, 0, .4},
                               {20, .4, 0},    {23, -.4, -.4}, {27, -.4, .4},  {37, 0, -.4},
                               {38, -.4, -.4}, {39, 0, -.4},   {40, 0, .4},    {41, .4, .4}};
  for (const auto& [number, x_mm, y_mm] : table_1) {
    vertices_mm.col(static_cast<int>(number) - 1) += Eigen::Vector2d(x_mm, y_mm);
  }

  const Model model(base);  // every whole degree to 180
  const FoldingHistory history = record_history(model, vertices_mm);
  int row = 0;
  while (history.stations[row].sample < history.verdict.deploys_from_sample) ++row;
  std::printf("deploys from %d deg\n", history.stations[row].sample);
  for (std::size_t i = 0; i < history.flat_mm.size(); ++i) {
    const Diagonal& diagonal = model.mechanism().diagonals[i];
    std::printf("A%d-A%d %.9f %.9f mm\n", diagonal.from + 1, diagonal.to + 1, history.flat_mm[i],
                history.length_mm(row, static_cast<Eigen::Index>(i)));
  }
}
