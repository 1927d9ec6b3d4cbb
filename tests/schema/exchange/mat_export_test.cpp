// MAT-files of every filling; tests/system/mat.sh reads them in Octave.
#include "schema/exchange/mat_export.hpp"

#include <gtest/gtest.h>

#include "schema/pattern/pattern_file.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {
namespace {

// Their keys hold lists of objects, and names of diagonals, which are no names of fields.
TEST(MatExport, KnowsEveryFilling) {
  const Pattern pattern = read_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json");
  const solver::OwnSheet own{pattern.base, pattern.shifts_mm, {1, 20, 0}};
  const FoldingView view{pattern, own.sheet};
  const solver::Diagonal& diagonal = view.mechanism.diagonals.front();
  solver::Springs springs;
  springs.single = {{{diagonal.from, diagonal.to}, 2, 100}};
  springs.preload.others = {{{diagonal.from, diagonal.to}, 2}};
  solver::RubberPlates plates;
  plates.cut_outs = {{0, {0.9, 0.8}}};
  for (const solver::Fill& fill : {solver::Fill(springs), solver::Fill(plates)}) {
    const std::string bytes = folded_mat("a.mat", view, solver::actuate(own.sheet, {fill, {}}),
                                         Sampling{}, "a sheet", Json::object());
    EXPECT_GT(bytes.size(), 1000u);
  }
}

}  // namespace
}  // namespace misalign::schema
