// A sheet whose panels bend: Table 1's.
#pragma once

#include <gtest/gtest.h>

#include "solver/bending/bent_panels.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {

struct Bent : testing::Test {
  Bent() : own(TestSheet(6, 6).base, shifts()) {}
  static Eigen::Matrix2Xd shifts() {
    const TestSheet sheet(6, 6);
    return sheet.shifted(golden("table1_odd.json")["displacements_mm"]) -
           sheet.base.sheet.vertices_mm;
  }
  ElasticSheet panels(double thickness_mm = 1, double stiffer = 1) const {
    return {own.sheet.vertices_mm(),
            own.sheet.panels(),
            own.sheet.mechanism().diagonals,
            {},
            thickness_mm,
            stiffer};
  }
  Eigen::Matrix3Xd folded(double pilot_deg) const {
    const FoldingWay& way = *own.sheet.way();
    SheetGeometry<double> geometry;
    place(own.sheet.mechanism(), own.sheet.vertices_mm(), geometry);
    FoldState<double> state = way.stations().front().state;
    way.find_state(way.x_of(pilot_deg), state);
    return own.model.shape().vertices_mm(geometry, state);
  }
  BentPanels bent(const ReleaseOptions& deploying, const BentPanelsOptions& options = {}) const {
    return *bend_panels(own.sheet, deploying, options);
  }
  static Filling springs(double n_per_mm, const Eigen::VectorXd& free_mm) {
    return Filling::of_springs(Eigen::VectorXd::Constant(free_mm.size(), n_per_mm), free_mm);
  }
  const OwnSheet own;
};

}  // namespace misalign::solver
