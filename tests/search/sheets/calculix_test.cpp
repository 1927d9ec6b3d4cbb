// The deck for CalculiX, read as ccx reads it, and what ccx writes, written here as ccx does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "schema/exchange/calculix_deck.hpp"
#include "schema/exchange/calculix_motion.hpp"
#include "schema/exchange/calculix_stress.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/release.hpp"
#include "search/sheets/studies.hpp"
#include "solver/motion/actuation.hpp"

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
        model_(chosen_.base, chosen_.sampling, chosen_.design),
        folded_(model_.sheet(chosen_.shifts_mm, "table1")),
        actuation_(solver::actuate(folded_, model_.actuators())),
        sheet_(release(model_, folded_, {}, "Table 1")) {}

  const ChosenSheet chosen_;
  FoldingModel model_;
  const solver::Sheet folded_;
  const solver::Actuation actuation_;
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

// Lines that begin with one star are keywords, and of two are comments (the manual of ccx).
TEST_F(Calculix, NamesBeginNoKeyword) {
  const auto keywords = [](const std::string& deck) {
    std::vector<std::string> all;
    std::istringstream lines(deck);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("*") && !line.starts_with("**")) all.push_back(line);
    }
    return all;
  };
  schema::DeckOptions options;
  const auto good = keywords(schema::calculix_deck(sheet_, options));
  options.material.name = "steel\n*INCLUDE, INPUT=stolen.txt\r*NODE";
  SimulatedSheet named = sheet_;
  named.title = "a sheet\n*INCLUDE, INPUT=stolen.txt";
  const std::string deck = schema::calculix_deck(named, options);
  EXPECT_EQ(keywords(deck), good);
  EXPECT_EQ(deck.find('\r'), std::string::npos);
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
  EXPECT_NEAR(energy_n_mm, actuation_.energy_n_mm[36], 1e-6);
}

// With relaxed lengths of a folded state: by coordinates of both decks.
TEST_F(Calculix, SpringsAreRelaxedWhereTheyAreToBe) {
  SimulationStart stop, there;
  stop.from_deg = 15;
  stop.rest_deg = 30;
  there.from_deg = 30;
  const SimulatedSheet sheet = release(model_, folded_, stop, "Table 1");
  const ReadDeck deck(schema::calculix_deck(sheet, {})),
      at30(schema::calculix_deck(release(model_, folded_, there, "Table 1"), {}));
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
  solver::ReleaseOptions options;
  options.from_deg = 15;
  options.sheet.springs().stiffness_n_per_mm = model_.actuators().springs().stiffness_n_per_mm;
  options.sheet.springs().rest_deg = 30;
  const auto rigid = deployed(folded_, options).run.rows;
  EXPECT_NEAR(energy_n_mm, rigid.front().springs_n_mm, 1e-6);
  schema::DeckOptions damped;
  damped.damping_per_s = 40;
  const std::string text = schema::calculix_deck(sheet, damped);
  EXPECT_NE(text.find("relaxed with the pilot at 30 deg"), std::string::npos);
  EXPECT_NE(text.find("\n*DAMPING, ALPHA=40\n*DENSITY\n"), std::string::npos);
  EXPECT_EQ(schema::calculix_deck(sheet, {}).find("DAMPING"), std::string::npos);

  stop.rest_deg = 157;
  EXPECT_THROW(release(model_, folded_, stop, "Table 1"), schema::UserError);
}

// As ccx writes the corners of panels that are as rigid ones at an angle, and energies.
std::string increment(const SimulatedSheet& start, const SimulatedSheet& now,
                      const std::string& time, const std::string& strain) {
  const schema::PanelMesh mesh(2);
  std::string text = "\n displacements (vx,vy,vz) for set CORNERS and time  " + time + "\n\n";
  for (int panel = 0; panel < 28; ++panel) {
    for (int i = 0; i < 4; ++i) {
      const int v = start.panels.corners[panel][i];
      const Vector3d moved = now.start_mm.col(v) - start.start_mm.col(v);
      text += fmt::format("{:10d}{:14.6E}{:14.6E}{:14.6E}\n", mesh.corner_node(panel, i), moved.x(),
                          moved.y(), moved.z());
    }
  }
  text += "\n total internal energy for set PANELS and time  " + time + "\n\n" + strain + "\n";
  return text + "\n total kinetic energy for set PANELS and time  " + time +
         "\n\n        1.250000E+00\n";
}

// Corners as rigid panels have them at 30 degrees, in ccx's digits and in two pieces.
TEST_F(Calculix, MotionIsReadAsItGrows) {
  SimulationStart later;
  later.from_deg = 30;
  const SimulatedSheet at30 = release(model_, folded_, later, "");
  const std::string text = increment(sheet_, at30, "0.2000000E-01", "        2.210653E+00");
  schema::MotionReader reader(sheet_, schema::PanelMesh(2));
  reader.feed(text.substr(0, 1234));
  ASSERT_EQ(reader.rows().size(), 1u);
  EXPECT_NEAR(reader.rows()[0].pilot_deg, 36, 1e-9);
  EXPECT_NEAR(reader.rows()[0].springs_n_mm, actuation_.energy_n_mm[36], 1e-8);
  reader.feed(text.substr(1234));
  ASSERT_EQ(reader.rows().size(), 2u);
  const solver::StressStudy::Row& row = reader.rows()[1];
  EXPECT_EQ(row.time_s, 0.02);
  EXPECT_NEAR(row.pilot_deg, 30, 1e-4);  // displacements of some mm with seven digits
  EXPECT_NEAR(row.widest_deg, folded_.history().fold_angle_deg.row(29).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_NEAR(row.springs_n_mm, actuation_.energy_n_mm[30], 2e-3);
  EXPECT_EQ(row.strain_n_mm, 2.210653);
  EXPECT_EQ(row.kinetic_n_mm, 1.25);
}

// What is no number, cannot be one, or comes from a time that was before, ends the motion.
TEST_F(Calculix, MotionEndsWhereNumbersDo) {
  const std::string good = increment(sheet_, sheet_, "0.1000000E-01", "        2.210653E+00");
  const auto rows_after = [&](std::string bad) {
    schema::MotionReader reader(sheet_, schema::PanelMesh(2));
    reader.feed(good + bad + increment(sheet_, sheet_, "0.3000000E-01", "        1.000000E+00"));
    EXPECT_EQ(reader.is_sound(), reader.rows().size() == 4) << bad.substr(0, 200);
    for (const solver::StressStudy::Row& row : reader.rows()) {
      EXPECT_TRUE(std::isfinite(row.pilot_deg + row.widest_deg + row.springs_n_mm +
                                row.strain_n_mm + row.kinetic_n_mm + row.time_s));
      EXPECT_GT(row.widest_deg, 30);
    }
    return reader.rows().size();
  };
  const std::string time = "0.2000000E-01";
  EXPECT_EQ(rows_after(increment(sheet_, sheet_, time, "        2.210653E+00")), 4u);
  EXPECT_EQ(rows_after(increment(sheet_, sheet_, time, "        2.210653-101")), 4u)
      << "as Fortran writes small numbers";
  for (const char* energy : {"                 NaN", "            Infinity", "        ************",
                             "        2.210653E+99", "        2.210653+101"}) {
    EXPECT_EQ(rows_after(increment(sheet_, sheet_, time, energy)), 2u) << energy;
  }
  EXPECT_EQ(rows_after(increment(sheet_, sheet_, "0.5000000E-02", "        2.210653E+00")), 2u);
  EXPECT_EQ(rows_after(increment(sheet_, sheet_, "          NaN", "        2.210653E+00")), 2u);
  for (const char* moved : {"           NaN", "**************", "  1.000000E+99"}) {
    std::string text = increment(sheet_, sheet_, time, "        2.210653E+00");
    text.replace(text.find("  0.000000E+00"), 14, moved);
    EXPECT_EQ(rows_after(text), 2u) << moved;
  }
}

std::string node(const char* key, int number, std::initializer_list<double> values) {
  std::string line = fmt::format("{}{:10d}", key, number);
  for (const double value : values) line += fmt::format("{:12.5E}", value);
  return line + "\n";
}

// One element of the second panel, with known stresses at a corner and in the middle of a side, in
// two frames; of a third only the begin.
TEST_F(Calculix, LargestStressAndItsPlace) {
  const schema::PanelMesh mesh(1);
  const auto& corners = sheet_.panels.corners[1];
  const Vector3d corner = sheet_.start_mm.col(corners[0]),
                 middle = (corner + Vector3d(sheet_.start_mm.col(corners[1]))) / 2;
  std::string text = "    1C\n    2C                             2\n";
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
  const solver::StressHistory stress = schema::read_stresses(file, "x.frd", sheet_, mesh, {});
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

// Numbers of nodes may be any, and stresses none that can be: then frames before that count.
TEST_F(Calculix, StressesEndWhereNumbersDo) {
  const schema::PanelMesh mesh(1);
  constexpr int kFar = 2'000'000'000;
  const auto& corners = sheet_.panels.corners[1];
  const Vector3d corner = sheet_.start_mm.col(corners[0]),
                 middle = (corner + Vector3d(sheet_.start_mm.col(corners[1]))) / 2;
  std::string text = "    1C\n    2C                             3\n";
  text += node(" -1", kFar, {middle.x(), middle.y(), middle.z()}) + node(" -1", -3, {1, 2, 3});
  text += " -1        12         NaN************ 1.00000E+00\n -3\n    3C     1\n";
  text += fmt::format(" -1         2    4    0    1\n -2{0:10d}{0:10d}{1:10d}\n -3\n", kFar, 12);
  const auto frame = [&](const char* time, const std::string& stress) {
    return fmt::format("  100CL  101 {}           2\n -4  STRESS      6    1\n -1{:10d}{}", time,
                       kFar, stress) +
           " 0.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00 0.00000E+00\n -3\n";
  };
  const auto read = [&](const std::string& frames) {
    std::istringstream file(text + frames);
    return schema::read_stresses(file, "x.frd", sheet_, mesh, {});
  };
  const std::string good = frame("1.00000E-03", " 3.00000E+02");
  EXPECT_TRUE(read(good).is_sound);
  for (const std::string& bad :
       {frame("2.00000E-03", "         NaN"), frame("2.00000E-03", "************"),
        frame("2.00000E-03", " 3.00000E+99"), frame("        NaN", " 3.00000E+02"),
        frame("0.50000E-03", " 3.00000E+02")}) {
    const solver::StressHistory stress = read(good + bad + frame("3.00000E-03", " 9.00000E+02"));
    EXPECT_FALSE(stress.is_sound);
    EXPECT_EQ(stress.time_s, std::vector<double>{0.001});
    ASSERT_TRUE(stress.anywhere);
    EXPECT_NEAR(stress.anywhere->stress_mpa, 300, 1e-9);
    EXPECT_EQ(stress.panel_outside_mpa[1], 300);
  }
}

}  // namespace
}  // namespace misalign::search
