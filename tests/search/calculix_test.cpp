// The deck for CalculiX, read as ccx reads it, and what ccx writes, written here as ccx does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "schema/exchange/calculix_deck.hpp"
#include "schema/exchange/calculix_result.hpp"
#include "search/checks/chosen_sheet.hpp"
#include "search/checks/release.hpp"

namespace misalign::search {
namespace {

using Eigen::Vector3d;
using schema::SimulatedSheet;

struct Spring {
  int from, to;
  std::vector<std::array<double, 2>> forces_n;  // with elongations, mm
};

// Nodes, elements, equations and springs of a deck.
struct ReadDeck {
  std::map<int, Vector3d> nodes_mm;
  std::map<int, std::vector<int>> elements;
  std::vector<std::vector<double>> equations;
  std::vector<Spring> springs;

  explicit ReadDeck(const std::string& text) {
    std::istringstream lines(text);
    std::string keyword;
    for (std::string line; std::getline(lines, line);) {
      if (line.empty() || std::isalpha(line[0])) continue;  // keys of what is to be written
      if (line.starts_with("*")) {
        keyword = line;
        continue;
      }
      std::vector<double> numbers;
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');)
        numbers.push_back(std::stod(field));
      if (!numbers.empty()) take(keyword, numbers);
    }
  }
  void take(const std::string& keyword, const std::vector<double>& numbers) {
    const std::vector<int> whole(numbers.begin(), numbers.end());
    if (keyword.starts_with("*NODE, NSET")) {
      nodes_mm[whole[0]] = {numbers[1], numbers[2], numbers[3]};
    } else if (keyword.starts_with("*ELEMENT, TYPE=S8R")) {
      elements[whole[0]] = {whole.begin() + 1, whole.end()};
    } else if (keyword.starts_with("*ELEMENT, TYPE=SPRINGA")) {
      springs.push_back({whole[1], whole[2], {}});
    } else if (keyword.starts_with("*SPRING, NONLINEAR")) {
      springs.back().forces_n.push_back({numbers[0], numbers[1]});
    } else if (keyword == "*EQUATION" && numbers.size() > 1) {
      equations.push_back(numbers);
    }
  }
};

class Calculix : public testing::Test {
 protected:
  Calculix()
      : chosen_(sheet_of_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json")),
        folder_(chosen_.base, chosen_.sampling, chosen_.actuators),
        folded_(folder_.fold(chosen_.shifts_mm)),
        sheet_(release(folder_, folded_, {}, "Table 1", "table1")) {}

  const ChosenSheet chosen_;
  const SheetFolder folder_;
  const FoldedSheet folded_;
  const SimulatedSheet sheet_;
};

// Equations tie nodes that are at one place, each node once, and leave as many places as the panels
// have together.
TEST_F(Calculix, PanelsAreTiedWhereTheyMeet) {
  for (const int n : {2, 3}) {
    schema::DeckOptions options;
    options.elements = n;
    const ReadDeck deck(schema::calculix_deck(sheet_, options));
    EXPECT_EQ(deck.elements.size(), 28u * n * n);
    std::set<std::pair<int, int>> tied;
    for (const auto& equation : deck.equations) {
      ASSERT_EQ(equation.size(), 6u);
      const int one = static_cast<int>(equation[0]), other = static_cast<int>(equation[3]);
      EXPECT_EQ(equation[1], equation[4]);
      EXPECT_EQ(equation[2], -equation[5]);
      EXPECT_LT((deck.nodes_mm.at(one) - deck.nodes_mm.at(other)).norm(), 1e-9);
      EXPECT_TRUE(tied.insert({one, static_cast<int>(equation[1])}).second) << one;
    }
    std::set<std::array<long, 3>> places;
    for (const auto& [node, at] : deck.nodes_mm) {
      places.insert(
          {std::lround(at.x() * 1e6), std::lround(at.y() * 1e6), std::lround(at.z() * 1e6)});
    }
    EXPECT_EQ(deck.nodes_mm.size(), 28u * (4 * n * n + 4 * n + 1 - n * n));
    // No two panels share a place by chance, and no node of 1e-6 mm lies on a boundary here.
    EXPECT_EQ(tied.size(), 3 * (deck.nodes_mm.size() - places.size()));
  }
}

TEST_F(Calculix, SpringsPullFromTheStart) {
  const ReadDeck deck(schema::calculix_deck(sheet_, {}));
  ASSERT_EQ(deck.springs.size(), 16u);
  double energy_n_mm = 0;
  for (const Spring& spring : deck.springs) {
    ASSERT_EQ(spring.forces_n.size(), 2u);
    const auto [force0, at0] = spring.forces_n[0];
    const auto [force1, at1] = spring.forces_n[1];
    EXPECT_NEAR((force1 - force0) / (at1 - at0), 50, 1e-9);
    EXPECT_LT(at0, -10);
    EXPECT_GT(at1, 10);
    const double now_n = force0 - 50 * at0;
    energy_n_mm += now_n * now_n / 100;
  }
  EXPECT_NEAR(energy_n_mm, folded_.actuation.energy_n_mm[36], 1e-6);
}

// With relaxed lengths of a folded state: by coordinates of both decks.
TEST_F(Calculix, SpringsAreRelaxedWhereTheyAreToBe) {
  ReleaseOptions stop, there;
  stop.from_deg = 15;
  stop.rest_deg = 30;
  there.from_deg = 30;
  const SimulatedSheet sheet = release(folder_, folded_, stop, "Table 1", "table1");
  const ReadDeck deck(schema::calculix_deck(sheet, {})),
      at30(schema::calculix_deck(release(folder_, folded_, there, "Table 1", "table1"), {}));
  ASSERT_EQ(deck.springs.size(), 16u);
  const auto length_mm = [](const ReadDeck& of, const Spring& spring) {
    return (of.nodes_mm.at(spring.from) - of.nodes_mm.at(spring.to)).norm();
  };
  double energy_n_mm = 0;
  for (const Spring& spring : deck.springs) {
    const double now_n = spring.forces_n[0][0] - 50 * spring.forces_n[0][1];
    EXPECT_NEAR(now_n, 50 * (length_mm(deck, spring) - length_mm(at30, spring)), 1e-8);
    energy_n_mm += now_n * now_n / 100;
  }
  DeployWish wish;
  wish.from_deg = 15;
  wish.sheet.springs.rest_deg = 30;
  Deployer deployer(chosen_.base, chosen_.sampling, chosen_.actuators, wish);
  const auto rigid = deployer.study(chosen_.shifts_mm, 15, "table1").run.rows;
  EXPECT_NEAR(energy_n_mm, rigid.front().springs_n_mm, 1e-6);
  schema::DeckOptions damped;
  damped.damping_per_s = 40;
  const std::string text = schema::calculix_deck(sheet, damped);
  EXPECT_NE(text.find("relaxed with the pilot at 30 deg"), std::string::npos);
  EXPECT_NE(text.find("\n*DAMPING, ALPHA=40\n*DENSITY\n"), std::string::npos);
  EXPECT_EQ(schema::calculix_deck(sheet, {}).find("DAMPING"), std::string::npos);

  stop.rest_deg = 157;
  EXPECT_THROW(release(folder_, folded_, stop, "Table 1", "table1"), schema::UserError);
}

// Corners as rigid panels have them at 30 degrees, in ccx's digits and in two pieces.
TEST_F(Calculix, MotionIsReadAsItGrows) {
  ReleaseOptions later;
  later.from_deg = 30;
  const SimulatedSheet at30 = release(folder_, folded_, later, "", "table1");
  const schema::PanelMesh mesh(2);
  std::string text = "\n displacements (vx,vy,vz) for set CORNERS and time  0.2000000E-01\n\n";
  for (int panel = 0; panel < 28; ++panel) {
    for (int i = 0; i < 4; ++i) {
      const int v = sheet_.panels.corners[panel][i];
      const Vector3d moved = at30.start_mm.col(v) - sheet_.start_mm.col(v);
      text += fmt::format("{:10d}{:14.6E}{:14.6E}{:14.6E}\n", mesh.corner_node(panel, i), moved.x(),
                          moved.y(), moved.z());
    }
  }
  text +=
      "\n total internal energy for set PANELS and time  0.2000000E-01\n\n        2.210653E+00\n";
  text +=
      "\n total kinetic energy for set PANELS and time  0.2000000E-01\n\n        1.250000E+00\n";
  schema::MotionReader reader(sheet_, mesh);
  reader.feed(text.substr(0, 1234));
  ASSERT_EQ(reader.rows().size(), 1u);
  EXPECT_NEAR(reader.rows()[0].pilot_deg, 36, 1e-9);
  EXPECT_NEAR(reader.rows()[0].springs_n_mm, folded_.actuation.energy_n_mm[36], 1e-8);
  reader.feed(text.substr(1234));
  ASSERT_EQ(reader.rows().size(), 2u);
  const schema::ElasticRow& row = reader.rows()[1];
  EXPECT_EQ(row.time_s, 0.02);
  EXPECT_NEAR(row.pilot_deg, 30, 1e-4);  // displacements of some mm with seven digits
  EXPECT_NEAR(row.widest_deg, folded_.path.history.fold_angle_deg.row(29).cwiseAbs().maxCoeff(),
              1e-4);
  EXPECT_NEAR(row.springs_n_mm, folded_.actuation.energy_n_mm[30], 2e-3);
  EXPECT_EQ(row.strain_n_mm, 2.210653);
  EXPECT_EQ(row.kinetic_n_mm, 1.25);
}

// One element of the second panel, with known stresses at a corner and in the middle of a side, in
// two frames; of a third only the begin.
TEST_F(Calculix, LargestStressAndItsPlace) {
  const schema::PanelMesh mesh(1);
  const auto& corners = sheet_.panels.corners[1];
  const Vector3d corner = sheet_.start_mm.col(corners[0]),
                 middle = (corner + Vector3d(sheet_.start_mm.col(corners[1]))) / 2;
  std::string text = "    1C\n    2C                             2\n";
  const auto node = [](const char* key, int number, std::initializer_list<double> values) {
    std::string line = fmt::format("{}{:10d}", key, number);
    for (const double value : values) line += fmt::format("{:12.5E}", value);
    return line + "\n";
  };
  text += node(" -1", 7, {corner.x(), corner.y(), corner.z()});
  text += node(" -1", 8, {middle.x(), middle.y(), middle.z()});
  text += " -3\n    3C                             1\n -1         2    4    0    1\n";
  text +=
      " -2         7         8         7         7         7         7         7         7"
      "         7         7\n -3\n";
  const auto frame = [&](const char* time, double shear_mpa) {
    return fmt::format("  100CL  101 {}           2\n -4  STRESS      6    1\n", time) +
           node(" -1", 7, {-300, 0, 0, 0, 0, 0}) + node(" -1", 8, {50, 50, 50, 0, -shear_mpa, 0});
  };
  text += frame("1.00000E-03", 10) + " -3\n" + frame("2.00000E-03", 20) + " -3\n";
  text += frame("3.00000E-03", 90);
  std::istringstream file(text);
  const schema::StressHistory stress = schema::read_stresses(file, "x.frd", sheet_, mesh, {});
  ASSERT_EQ(stress.time_s, (std::vector<double>{0.001, 0.002}));
  ASSERT_TRUE(stress.anywhere && stress.outside);
  EXPECT_NEAR(stress.anywhere->stress_mpa, 300, 1e-9);
  EXPECT_NEAR(stress.outside->stress_mpa, std::sqrt(3) * 20, 1e-9);
  EXPECT_EQ(stress.outside->time_s, 0.002);
  EXPECT_EQ(stress.outside->panel, 1);
  const Eigen::Vector2d flat_mm =
      (sheet_.flat_mm.col(corners[0]) + sheet_.flat_mm.col(corners[1])) / 2;
  EXPECT_LT((stress.outside->flat_mm - flat_mm).norm(), 1e-3);
  EXPECT_EQ(stress.panel_outside_mpa[0], 0);
  std::istringstream nothing("");
  EXPECT_THROW(schema::read_stresses(nothing, "x.frd", sheet_, mesh, {}), schema::UserError);
}

}  // namespace
}  // namespace misalign::search
