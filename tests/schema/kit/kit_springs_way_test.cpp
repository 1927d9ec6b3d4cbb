// The section on the way of springs beside the mechanism: what each hook hangs in, the order, and
// springs that push.
#include "schema/kit/kit_springs_way.hpp"

#include <gtest/gtest.h>

#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::schema {
namespace {

constexpr double kUsed_deg = 100;

class SpringsWay : public testing::Test {
 protected:
  static solver::OwnSheet table1() {
    const solver::TestSheet sheet{6, 6};
    return solver::OwnSheet(sheet.base,
                            sheet.shifted(solver::golden("table1_odd.json")["displacements_mm"]) -
                                sheet.base.sheet.vertices_mm);
  }
  std::string section(const Design& design, SpringAt at) const {
    KitOptions options;
    options.spring_bore_mm = 1.5;
    options.spring_at = at;
    return springs_way_section(own_.sheet, design, kit_fittings(own_.sheet, options), kUsed_deg);
  }
  const std::vector<solver::Diagonal>& diagonals() const {
    return own_.sheet.mechanism().diagonals;
  }
  bool is_ball(int vertex) const {
    const auto& balls = own_.sheet.mechanism().balls;
    return std::any_of(balls.begin(), balls.end(),
                       [&](const solver::BallJoint& ball) { return ball.vertex == vertex; });
  }
  // A design with one spring of 1 N/mm on each of these diagonals.
  Design on(const std::vector<std::pair<int, std::optional<double>>>& springs) const {
    Design design;
    design.diameter_mm = 2;
    for (const solver::Diagonal& diagonal : diagonals()) {
      design.single_springs.push_back({{diagonal.from, diagonal.to}, 0, {}});
    }
    for (const auto& [d, free_mm] : springs) {
      design.single_springs[static_cast<std::size_t>(d)].stiffness_n_per_mm = 1;
      design.single_springs[static_cast<std::size_t>(d)].free_mm = free_mm;
    }
    return design;
  }

  const solver::OwnSheet own_ = table1();
};

TEST_F(SpringsWay, NamesWhatEachHookHangsIn) {
  const std::string at_vertices = section(on({{0, {}}, {3, {}}, {5, {}}}), SpringAt::vertex);
  int tabs = 0, loops = 0;
  for (const int d : {0, 3, 5}) {
    EXPECT_NE(at_vertices.find("<td>s" + std::to_string(d) + "</td>"), std::string::npos);
    const solver::Diagonal& diagonal = diagonals()[static_cast<std::size_t>(d)];
    for (const int vertex : {diagonal.from, diagonal.to}) {
      const std::string place = is_ball(vertex) ? ": loop of the ball joint" : ": tab of r";
      EXPECT_NE(at_vertices.find("<td>" + solver::vertex_label(vertex) + place), std::string::npos)
          << at_vertices;
      ++(is_ball(vertex) ? loops : tabs);
    }
  }
  EXPECT_GT(tabs, 0);
  EXPECT_GT(loops, 0);
  EXPECT_EQ(at_vertices.find("<td>s1</td>"), std::string::npos);
  const std::string in_panels = section(on({{0, {}}}), SpringAt::panel);
  EXPECT_NE(in_panels.find(": bore of r"), std::string::npos) << in_panels;
}

TEST_F(SpringsWay, ListsSpringsInTheOrderOfHanging) {
  const std::string text = section(on({{0, {}}, {2, {}}, {4, {}}, {6, {}}}), SpringAt::vertex);
  std::size_t at = 0;
  for (int turn = 1; turn <= 4; ++turn) {
    at = text.find("<tr><td>" + std::to_string(turn) + "</td><td>s", at);
    ASSERT_NE(at, std::string::npos) << text;
  }
  EXPECT_EQ(text.find("<tr><td>5</td>"), std::string::npos);
  EXPECT_EQ(text.find("guide"), std::string::npos) << "relaxed springs pull or push, as they fold";
}

TEST_F(SpringsWay, GivesGuidesToSpringsThatPush) {
  // Longer than at any angle, and shorter.
  const std::string text = section(on({{0, 200.0}, {3, 50.0}}), SpringAt::vertex);
  const std::size_t guide = text.find("push: give each a guide");
  ASSERT_NE(guide, std::string::npos) << text;
  EXPECT_EQ(text.substr(guide - 4, 4), " s0 ");
}

TEST_F(SpringsWay, IsEmptyWithoutSprings) {
  Design design;
  design.fill_kind = FillKind::none;
  EXPECT_EQ(section(design, SpringAt::vertex), "");
}

}  // namespace
}  // namespace misalign::schema
