// Loads of rubber plates on the panels: in balance, and their work on moving panels is the energy
// that the plates lose.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "solver/motion/panel_loads.hpp"
#include "solver/pattern/outline.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// The centroid of a flat panel, from its two triangles.
Vector3d centroid(const Matrix3Xd& at_mm) {
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (const int k : {1, 2}) {
    const Vector3d one = at_mm.col(k) - at_mm.col(0), other = at_mm.col(k + 1) - at_mm.col(0);
    const double twice = one.cross(other).norm();
    area += twice;
    sum += twice * (at_mm.col(0) + at_mm.col(k) + at_mm.col(k + 1)) / 3;
  }
  return sum / area;
}

TEST(PlateLoads, BalanceAndDoTheWork) {
  const TestSheet sheet(6, 6);
  const FlatVertices vertices_mm = sheet.shifted(golden("table1_odd.json")["displacements_mm"]);
  const OwnSheet own(sheet.base, vertices_mm - sheet.base.sheet.vertices_mm);
  const FoldingWay& way = *own.sheet.way();
  for (const double prestretch : {1.0, 1.1}) {
    EnergyModel::Options options;
    RubberPlates plates;
    plates.prestretch = prestretch;
    options.fill = plates;
    const EnergyModel model(own.sheet, options);
    PanelLoads loads(model, own.model.shape(), sheet.base, false);
    Deployment::Row row{};
    const auto vertices_at = [&](double x) {
      row.x = x;
      loads.pose(row);
      std::vector<Matrix3Xd> panels;
      for (const int facet : kept_facets(sheet.base.sheet, sheet.base.holes)) {
        Matrix3Xd& at_mm = panels.emplace_back(3, 4);
        for (int k = 0; k < 4; ++k) {
          at_mm.col(k) = loads.place_mm(loads.panel_of(facet),
                                        sheet.base.sheet.facets[static_cast<std::size_t>(facet)]
                                                               [static_cast<std::size_t>(k)]);
        }
      }
      return panels;
    };
    const double x = way.x_of(90), step = 1e-4;
    const auto before = vertices_at(x - step), after = vertices_at(x + step), here = vertices_at(x);
    const Eigen::VectorXd of_panels = loads.find();
    Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
    double power = 0, largest_n = 0;
    for (std::size_t k = 0; k < here.size(); ++k) {
      const Vector3d force_n = of_panels.segment<3>(6 * static_cast<Index>(k)),
                     moment_n_mm = of_panels.segment<3>(6 * static_cast<Index>(k) + 3);
      const Vector3d centre_mm = centroid(here[k]);
      force += force_n;
      moment += centre_mm.cross(force_n) + moment_n_mm;
      largest_n = std::max(largest_n, force_n.norm());
      const Vector3d velocity = (centroid(after[k]) - centroid(before[k])) / (2 * step);
      const Eigen::Matrix3d turn = Eigen::umeyama(before[k], after[k], false).topLeftCorner<3, 3>();
      const Eigen::AngleAxisd turned(turn);
      power += force_n.dot(velocity) + moment_n_mm.dot(turned.axis() * turned.angle()) / (2 * step);
    }
    ASSERT_GT(largest_n, 0.1);
    EXPECT_LT(force.norm(), 1e-9 * largest_n);
    EXPECT_LT(moment.norm(), 1e-9 * largest_n * 500);
    const double slope = model.filled(x).slope;
    EXPECT_NEAR(power, -slope, 1e-5 * std::abs(slope)) << prestretch;  // differences over 1e-4
  }
}

}  // namespace
}  // namespace misalign::solver
