// JSON of how springs hold a sheet at the target of its mesh.
#include <gtest/gtest.h>

#include "schema/exchange/folding_json.hpp"
#include "schema/pattern/mesh_target.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "tests/solver/designed_mesh.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {
namespace {

TEST(TargetJson, IsOfTheRestAtTheTargetAlone) {
  const solver::DesignedMesh mesh = solver::curved_mesh(6, 6, {6e-4, -4e-4}, 0.5, 7);
  Json fold = fold_json(mesh.flat, std::vector<int>(mesh.flat.edges.size(), 0));
  add_folded_form(mesh.folded_mm, fold);
  const PatternFile read = read_sampled_pattern(fold, "a mesh", ".");
  const double end_deg = read.pattern.base.folding.end_deg();
  const solver::OwnSheet own(read.pattern.base, read.pattern.shifts_mm, {.end_deg = end_deg});
  const FoldingView view(read.pattern, own.sheet);
  const Json json = target_json(view, read.design.fill(read.pattern.base));
  EXPECT_EQ(json["rest_deg"], read.pattern.folded_target->pilot_deg);
  EXPECT_LT(json["driven_from_below_deg"], json["rest_deg"]);
  EXPECT_GT(json["driven_from_deg"], json["rest_deg"]);
  EXPECT_LE(json["driven_from_deg"], end_deg);
  EXPECT_GT(json["barrier_n_mm"], 0.01);
  EXPECT_LT(json["shape_off_mm"], 1e-9);
  EXPECT_TRUE(target_json(view, solver::Springs{}).is_null());
  EXPECT_TRUE(target_json(view, solver::NoFill{}).is_null());
  // A displaced vertex takes the shape off by as much, and more where the sheet is soft.
  Json shifted = pattern_json(read.pattern, read.pattern.shifts_mm);
  shifted["displacements_mm"] = {{"A17", {0.1, 0}}};
  const PatternFile off = read_sampled_pattern(shifted, "a sheet", ".");
  const solver::OwnSheet other(off.pattern.base, off.pattern.shifts_mm, {.end_deg = end_deg});
  const auto off_mm = off_target_mm({off.pattern, other.sheet});
  ASSERT_TRUE(off_mm);
  EXPECT_GT(*off_mm, 0.02);
  EXPECT_LT(*off_mm, 2);
  // Plates have a rest there, too; a sheet without a target has no such value.
  Pattern plain = read.pattern;
  plain.folded_target.reset();
  EXPECT_FALSE(off_target_mm({plain, own.sheet}));
  EXPECT_FALSE(
      target_json(view, solver::RubberPlates{.rest_deg = read.pattern.folded_target->pilot_deg})
          .is_null());
}

}  // namespace
}  // namespace misalign::schema
