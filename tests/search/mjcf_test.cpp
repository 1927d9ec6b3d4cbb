// MuJoCo runs what is written for it.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "schema/campaign/campaign_file.hpp"
#include "schema/exchange/mjcf_export.hpp"
#include "schema/files/output_file.hpp"
#include "search/draws/draw.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/release.hpp"
#include "search/sheets/studies.hpp"
#include "solver/motion/actuation.hpp"
#include "tests/bench/mujoco_comparison.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

using schema::SimulatedSheet;

// The paper's Table 1, to be let go at its 36 degrees.
class Table1 {
 public:
  Table1()
      : sheet_(sheet_of_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json")),
        model_(sheet_.base, sheet_.sampling, sheet_.design),
        folded_(model_.sheet(sheet_.shifts_mm, "table1")),
        actuation_(solver::actuate(folded_, model_.actuators())) {}
  SimulatedSheet released(const SimulationStart& options = {}) const {
    return release(model_, folded_, options, "Table 1 -- <as printed>");
  }
  const solver::Actuation& actuation() const { return actuation_; }

 private:
  const ChosenSheet sheet_;
  FoldingModel model_;
  const solver::Sheet folded_;
  const solver::Actuation actuation_;
};

MujocoRun run_of(const SimulatedSheet& sheet, const schema::MjcfOptions& options = {}) {
  const Folder folder("mjcf");
  const std::string file = folder.file("sheet.xml");
  schema::write_text_file(file, schema::mjcf_model(sheet, options));
  return MujocoRun(file);
}

// How far apart the panels that meet at a vertex carry it.
double widest_gap_mm(const SimulatedSheet& sheet, const MujocoRun& run) {
  std::map<int, std::vector<Eigen::Vector3d>> places_mm;
  for (std::size_t k = 0; k < sheet.panels.corners.size(); ++k) {
    const std::string body = "panel" + std::to_string(sheet.panels.facets[k]);
    for (const int v : sheet.panels.corners[k]) {
      places_mm[v].push_back(run.carried(body, sheet.start_mm.col(v)));
    }
  }
  double widest_mm = 0;
  for (const auto& [v, places] : places_mm) {
    for (const Eigen::Vector3d& place : places) {
      widest_mm = std::max(widest_mm, (place - places.front()).norm());
    }
  }
  return widest_mm;
}

double area_mm2(const SimulatedSheet& sheet) {
  double twice = 0;
  for (const auto& corners : sheet.panels.corners) {
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d a = sheet.flat_mm.col(corners[i]),
                            b = sheet.flat_mm.col(corners[(i + 1) % 4]);
      twice += a.x() * b.y() - a.y() * b.x();
    }
  }
  return twice / 2;
}

TEST(Mujoco, MovesTable1AsItsSpringsSay) {
  const Table1 table1;
  const SimulatedSheet sheet = table1.released();
  MujocoRun run = run_of(sheet);
  // 1 mm of 2.7 g/cm^3.
  EXPECT_NEAR(run.mass_t(), 2.7e-9 * area_mm2(sheet), 1e-15);
  EXPECT_NEAR(run.pilot_deg(), 36, 1e-9);
  EXPECT_LT(widest_gap_mm(sheet, run), 1e-9);

  const solver::Actuation& actuation = table1.actuation();
  double energy_n_mm = run.spring_energy_n_mm(), pilot_deg = 36, widest_mm = 0;
  EXPECT_NEAR(energy_n_mm, actuation.energy_n_mm[36], 1e-9);
  std::map<int, double> passed_s;
  for (int next_deg = 35; next_deg > 0;) {
    ASSERT_LT(run.time_s(), 0.2) << "at " << run.pilot_deg() << " deg";
    run.step();
    const double now_n_mm = run.spring_energy_n_mm(), now_deg = run.pilot_deg();
    widest_mm = std::max(widest_mm, widest_gap_mm(sheet, run));
    if (now_deg <= next_deg) {
      // Straight between two steps, a fifteenth of a degree apart at most.
      const double share = (pilot_deg - next_deg) / (pilot_deg - now_deg);
      const double there_n_mm = energy_n_mm + share * (now_n_mm - energy_n_mm);
      // Rounding apart, springs differ by no more than their two ends, where loops are open.
      const double pulls_n = actuation.force_n.row(next_deg).cwiseAbs().sum();
      EXPECT_NEAR(there_n_mm, actuation.energy_n_mm[next_deg], 2 * widest_mm * pulls_n + 1e-6)
          << next_deg;
      passed_s[next_deg--] = run.time_s();
    }
    energy_n_mm = now_n_mm, pilot_deg = now_deg;
  }
  // Rigid motion by other programs, rounded to 1e-4 s; MuJoCo's steps are as long.
  for (const auto& [angle_deg, time_s] :
       std::map<int, double>{{30, 0.0433}, {20, 0.0704}, {10, 0.0892}, {5, 0.0972}}) {
    EXPECT_NEAR(passed_s[angle_deg], time_s, 3e-4) << angle_deg;
  }
  EXPECT_LT(widest_mm, 2e-4);  // 1.0e-4 was seen
  // The moments of inertia: half of M times the rate squared is the kinetic energy. M by the same
  // programs, in kg mm^2.
  const double rate = run.pilot_rate_deg_per_s() * std::numbers::pi / 180;
  EXPECT_NEAR(2 * run.kinetic_energy_n_mm() / (rate * rate) * 1e3, 81.4, 0.2);
}

// Scaled by s, springs of the same stiffness hold s^2 the energy and panels have s^5 the moments of
// inertia: it takes s^1.5 the time. That of the unscaled sheet is by other programs, as above.
TEST(Mujoco, MovesSheetsOfAnySizeAlike) {
  struct Size {
    double scale, time_unit_s, mass_unit_t;
  };
  for (const Size& size : {Size{1. / 500, 1e-3, 1e-6}, Size{2e-6, 1e-6, 1e-12}}) {
    SimulatedSheet sheet = Table1().released();
    sheet.start_mm *= size.scale;
    sheet.rest_mm *= size.scale;
    sheet.flat_mm *= size.scale;
    sheet.plates.thickness_mm *= size.scale;
    schema::MjcfOptions held;
    held.friction_n_mm_per_mm = 100 * size.scale;  // as far above critical friction at any scale
    MujocoRun run = run_of(sheet), still = run_of(sheet, held);
    const double mass_t = 2.7e-9 * sheet.plates.thickness_mm * area_mm2(sheet);
    EXPECT_NEAR(run.mass_t() * size.mass_unit_t, mass_t, 1e-9 * mass_t);
    EXPECT_NEAR(run.pilot_deg(), 36, 1e-9);
    const double flat_s = 0.0972 * std::pow(size.scale, 1.5);  // to 5 degrees
    while (run.pilot_deg() > 5 && run.time_s() * size.time_unit_s < 2 * flat_s) {
      run.step();
      still.step();
    }
    EXPECT_NEAR(run.time_s() * size.time_unit_s, flat_s, 0.01 * flat_s) << size.scale;
    EXPECT_NEAR(still.pilot_deg(), 36, 0.05) << size.scale;
  }
}

// Twice the thickness weighs twice; friction holds hinges of the tree.
TEST(Mujoco, HasThicknessAndFriction) {
  const Table1 table1;
  SimulationStart options;
  options.plates.thickness_mm = 2;
  options.from_deg = 60.5;
  const SimulatedSheet sheet = table1.released(options);
  schema::MjcfOptions held;
  held.friction_n_mm_per_mm = 100;
  MujocoRun run = run_of(sheet, held);
  EXPECT_NEAR(run.mass_t(), 5.4e-9 * area_mm2(sheet), 1e-15);
  for (int i = 0; i < 100; ++i) run.step();
  EXPECT_NEAR(run.pilot_deg(), 60.5, 0.01);
}

// Springs that are relaxed where it is let go hold it there; nothing else moves it.
TEST(Mujoco, StaysWhereSpringsAreRelaxed) {
  const Table1 table1;
  SimulationStart options;
  options.from_deg = options.rest_deg = 30;
  MujocoRun still = run_of(table1.released(options));
  EXPECT_LT(still.spring_energy_n_mm(), 1e-12);
  for (int i = 0; i < 100; ++i) still.step();
  EXPECT_NEAR(still.pilot_deg(), 30, 1e-6);
  options.from_deg = 15;
  MujocoRun pushed = run_of(table1.released(options));
  for (int i = 0; i < 100; ++i) pushed.step();
  EXPECT_GT(pushed.pilot_deg(), 15);
}

// A 4 x 4 sheet beside `misalign deploy`: 1e-5 of the start's angle was seen, and 1e-3 of critical
// frictions (results/deployment/simulators.md). Friction of MuJoCo's constraints creeps a little.
TEST(Mujoco, DeploysAsDeployDoes) {
  schema::Campaign campaign =
      schema::read_campaign_file(MISALIGN_SOURCE_DIR "/search/campaigns/miura-4x4.json");
  campaign.design.stiffness_n_per_mm = 1000;  // it takes a quarter of the time
  FoldingModel model(campaign);
  const solver::Sheet folded = model.sheet(shifts_of_draw(campaign, 1112));
  const SimulatedSheet sheet = release(model, folded, {}, "a sheet");
  solver::ReleaseOptions springs;
  springs.sheet.springs().stiffness_n_per_mm = campaign.design.springs().stiffness_n_per_mm;
  const solver::Deployment rigid = deployed(folded, springs).run;
  ASSERT_EQ(rigid.outcome, solver::Outcome::passed_flat);
  EXPECT_LT(largest_difference(sheet, rigid.rows, false), 1e-4);
  const double critical =
      critical_by_energy(sheet, folded.history(),
                         solver::actuate(folded, campaign.design.actuators(campaign.pattern.base)));
  MujocoRun less = load(sheet, 0.99 * critical), more = load(sheet, 1.01 * critical);
  EXPECT_TRUE(gets_flat(less, rigid.last().time_s));
  EXPECT_FALSE(gets_flat(more, rigid.last().time_s));
}

}  // namespace
}  // namespace misalign::search
