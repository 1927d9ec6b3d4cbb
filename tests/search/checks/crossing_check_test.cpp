#include "search/checks/crossing_check.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::search {
namespace {

// Two unit squares without a common vertex, the second one anywhere.
class TwoPanels {
 public:
  bool cross(const Eigen::Matrix<double, 3, 4>& second) {
    Eigen::Matrix3Xd corners(3, 8);
    corners << square(), second;
    return check_.crossing(corners).has_value();
  }
  static Eigen::Matrix<double, 3, 4> square() {
    return Eigen::Matrix<double, 3, 4>{{0, 1, 1, 0}, {0, 0, 1, 1}, {0, 0, 0, 0}};
  }
  /// Upright in the plane x = 0.5, between these heights and from this y on.
  static Eigen::Matrix<double, 3, 4> upright(double lowest, double y = 0.2) {
    return Eigen::Matrix<double, 3, 4>{
        {0.5, 0.5, 0.5, 0.5}, {y, y + 1, y + 1, y}, {lowest, lowest, lowest + 1, lowest + 1}};
  }

 private:
  CrossingCheck check_{Eigen::Matrix2Xd{{0, 1, 1, 0, 3, 4, 4, 3}, {0, 0, 1, 1, 0, 0, 1, 1}},
                       {{0, 1, 2, 3}, {4, 5, 6, 7}}};
};

TEST(CrossingCheck, CrossingPanels) {
  TwoPanels panels;
  EXPECT_TRUE(panels.cross(TwoPanels::upright(-0.5)));
  EXPECT_TRUE(panels.cross(TwoPanels::upright(-1e-3)));
  EXPECT_TRUE(panels.cross(TwoPanels::upright(-0.5, 1 - 1e-3)));
  EXPECT_FALSE(panels.cross(TwoPanels::upright(1e-3)));
  EXPECT_FALSE(panels.cross(TwoPanels::upright(-0.5, 1 + 1e-3)));
}

TEST(CrossingCheck, ParallelPanels) {
  TwoPanels panels;
  for (const double height : {0.1, 1e-9, 0.0, -1e-9}) {
    Eigen::Matrix<double, 3, 4> above = TwoPanels::square();
    above.row(0).array() += 0.3;
    above.row(2).array() += height;
    EXPECT_FALSE(panels.cross(above)) << height;
  }
}

// An edge on a face, and edge on edge: no crossing to within kTouch, beyond it one.
TEST(CrossingCheck, TouchingPanels) {
  TwoPanels panels;
  EXPECT_FALSE(panels.cross(TwoPanels::upright(0)));
  EXPECT_FALSE(panels.cross(TwoPanels::upright(-0.5 * kTouch)));
  EXPECT_TRUE(panels.cross(TwoPanels::upright(-5 * kTouch)));
  EXPECT_FALSE(panels.cross(TwoPanels::upright(-0.5, 1)));
  EXPECT_FALSE(panels.cross(TwoPanels::upright(-0.5, 1 - 0.5 * kTouch)));
  EXPECT_TRUE(panels.cross(TwoPanels::upright(-0.5, 1 - 5 * kTouch)));
}

TEST(CrossingCheck, PanelsWithACommonVertexAreNotCompared) {
  CrossingCheck check(Eigen::Matrix2Xd{{0, 1, 1, 0, -1, -1, 0}, {0, 0, 1, 1, 0, -1, -1}},
                      {{0, 1, 2, 3}, {0, 4, 5, 6}});
  Eigen::Matrix3Xd corners(3, 8);
  corners << TwoPanels::square(), TwoPanels::upright(-0.5);
  EXPECT_FALSE(check.crossing(corners));
}

// Whether an edge of one quadrilateral passes through another one, by signs of volumes: nothing of
// FCL's.
bool edge_through(const Eigen::Matrix3Xd& corners, int one, int other) {
  const auto volume = [](const auto& a, const auto& b, const auto& c, const auto& d) {
    return (b - a).cross(c - a).dot(d - a);
  };
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d p = corners.col(4 * one + k), q = corners.col(4 * one + (k + 1) % 4);
    for (const auto& [i, j] : {std::pair(1, 2), {2, 3}}) {
      const Eigen::Vector3d a = corners.col(4 * other), b = corners.col(4 * other + i),
                            c = corners.col(4 * other + j);
      if (volume(a, b, c, p) * volume(a, b, c, q) >= 0) continue;
      const double u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
      if ((u > 0) == (v > 0) && (v > 0) == (w > 0)) return true;
    }
  }
  return false;
}

// Draws of a pattern that folds into itself: every 3rd degree of the path, against all pairs of
// panels looked at one by one.
TEST(CrossingCheck, FoldedSheetsAgainstAllPairs) {
  int crossing = 0, clear = 0;
  for (const char* name : {"turned-quads-6x6", "miura-6x6"}) {
    const schema::Campaign campaign = schema::read_campaign_file(
        MISALIGN_SOURCE_DIR "/search/campaigns/" + std::string(name) + ".json");
    const solver::PerforatedSheet& base = campaign.pattern.base;
    const solver::Model model(base, {1, 120});
    std::vector<std::array<int, 4>> panels;
    for (int f = 0; f < base.sheet.facet_count(); ++f) {
      if (!std::binary_search(base.holes.begin(), base.holes.end(), f)) {
        panels.push_back(base.sheet.facets[f]);
      }
    }
    const auto shared = [&](int a, int b) {
      return std::find_first_of(panels[a].begin(), panels[a].end(), panels[b].begin(),
                                panels[b].end()) != panels[a].end();
    };
    for (const std::uint64_t draw : {0, 5}) {
      Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, base.sheet.vertex_count());
      draw_shifts(campaign.misalignment, campaign.seed, draw, shifts_mm);
      const solver::FlatVertices vertices_mm = base.sheet.vertices_mm + shifts_mm;
      solver::SheetGeometry<double> geometry;
      solver::place(model.mechanism(), vertices_mm, geometry);
      CrossingCheck check(vertices_mm, panels);
      const solver::StationVisitor compare = [&](const solver::Station& station,
                                                 const solver::PathPoint& point) {
        if (station.sample % 3 != 0) return;
        const Eigen::Matrix3Xd corners = model.shape().corners_mm(geometry, point.state);
        bool expected = false;
        for (int a = 0; a < static_cast<int>(panels.size()); ++a) {
          for (int b = 0; b < a; ++b) {
            if (shared(a, b)) continue;
            expected = expected || edge_through(corners, a, b) || edge_through(corners, b, a);
          }
        }
        const auto found = check.crossing(corners);
        EXPECT_EQ(found.has_value(), expected)
            << name << ", draw " << draw << " at " << station.pilot_deg;
        if (found) {
          EXPECT_FALSE(shared(found->first, found->second));
        }
        ++(expected ? crossing : clear);
      };
      solver::record_history(model, vertices_mm, &compare);
    }
  }
  EXPECT_GE(crossing, 10);
  EXPECT_GE(clear, 100);
}

}  // namespace
}  // namespace misalign::search
