// Tables of springs: one sentence for each fault, with its line; and common springs by the formulas
// of helical springs.
#include "schema/pattern/spring_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "schema/files/user_error.hpp"

namespace misalign::schema {
namespace {

using solver::SpringAction;

constexpr const char* kHeader = "name,rate_n_per_mm,free_mm,longest_mm,wire_mm,outer_mm,price";

std::string sentence_of(const std::string& text) {
  try {
    spring_table_of(text, "springs.csv");
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_input);
    return error.what();
  }
  return "";
}

TEST(SpringTable, ReadsColumnsInAnyOrder) {
  const auto table = spring_table_of(
      "# from a "
      "shop\nprice,name,kind,free_mm,outer_mm,wire_mm,longest_mm,shortest_mm,rate_n_per_mm,"
      "initial_n\n0.5,\"E-1, zinc\",,30,5,0.5,60,,0.2,0.4\n0.9,D-1,pushes,40,8,0.8,,22,1.5,\n",
      "springs.csv");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0].name, "E-1, zinc");
  EXPECT_EQ(table[0].spring.action, SpringAction::pulls);
  EXPECT_EQ(table[0].spring.rate_n_per_mm, 0.2);
  EXPECT_EQ(table[0].spring.free_mm, 30);
  EXPECT_EQ(table[0].spring.limit_mm, 60);
  EXPECT_EQ(table[0].spring.wire_mm, 0.5);
  EXPECT_EQ(table[0].spring.outer_mm, 5);
  EXPECT_EQ(table[0].spring.price, 0.5);
  EXPECT_EQ(table[0].spring.initial_n, 0.4);
  EXPECT_EQ(table[1].spring.action, SpringAction::pushes);
  EXPECT_EQ(table[1].spring.limit_mm, 22);
  EXPECT_EQ(table[1].spring.initial_n, 0);
}

TEST(SpringTable, RefusesEachFaultInOneSentence) {
  const std::string good = "E,0.2,30,60,0.5,5,1";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "the table (is empty)"},
      {std::string(kHeader) + "\n", "the table (has no springs)"},
      {"name;rate\n" + good, "line 1: name;rate (is no column of springs"},
      {"name,rate_n_per_mm,free_mm,longest_mm,wire_mm,outer_mm\n" + good,
       "line 1: price (is missing)"},
      {"name,name,rate_n_per_mm,free_mm,longest_mm,wire_mm,outer_mm,price\n" + good,
       "line 1: name (occurs twice)"},
      {"rate_n_per_mm,free_mm,wire_mm,outer_mm,price,name\n" + good, "longest_mm (is missing)"}};
  for (const auto& [text, words] : cases) {
    EXPECT_NE(sentence_of(text).find(words), std::string::npos) << sentence_of(text);
  }
  const std::vector<std::pair<std::string, std::string>> rows = {
      {",0.2,30,60,0.5,5,1", "line 3: name (is missing)"},
      {"E,0.2,30,60,0.5,5,1", "line 3: name = E (is the name of line 2, too)"},
      {"F,x,30,60,0.5,5,1", "line 3: rate_n_per_mm = x (is no number)"},
      {"F,,30,60,0.5,5,1", "line 3: rate_n_per_mm (is missing)"},
      {"F,0,30,60,0.5,5,1", "line 3: rate_n_per_mm = 0 (must be from 1e-06"},
      {"F,nan,30,60,0.5,5,1", "line 3: rate_n_per_mm = nan (is no number)"},
      {"F,0.2,-30,60,0.5,5,1", "line 3: free_mm = -30 (must be from"},
      {"F,0.2,30,30,0.5,5,1", "line 3: longest_mm = 30 (must be more than free_mm)"},
      {"F,0.2,30,,0.5,5,1", "line 3: longest_mm (is missing)"},
      {"F,0.2,30,60,3,5,1", "line 3: wire_mm = 3 (must be less than half of outer_mm)"},
      {"F,0.2,30,60,0.5,,1", "line 3: outer_mm (is missing)"},
      {"F,0.2,30,60,0.5,5,-1", "line 3: price = -1 (must be from 0"},
      {"F,0.2,30,60,0.5,5,1,2", "line 3 (has more cells than there are columns)"}};
  for (const auto& [row, words] : rows) {
    const std::string sentence = sentence_of(std::string(kHeader) + "\n" + good + "\n" + row);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  }
  const std::string with_kind = std::string(kHeader) + ",kind,shortest_mm,initial_n\n";
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {"F,0.2,30,60,0.5,5,1,twists,,", "line 2: kind = twists (is no kind of springs)"},
      {"F,0.2,30,60,0.5,5,1,pulls,20,", "line 2: shortest_mm = 20 (is not of a spring that pulls)"},
      {"F,0.2,30,60,0.5,5,1,pushes,20,",
       "line 2: longest_mm = 60 (is not of a spring that pushes)"},
      {"F,0.2,30,,0.5,5,1,pushes,,", "line 2: shortest_mm (is missing)"},
      {"F,0.2,30,,0.5,5,1,pushes,30,", "line 2: shortest_mm = 30 (must be less than free_mm)"},
      {"F,0.2,30,,0.5,5,1,pushes,20,1", "line 2: initial_n = 1 (is not of a spring that pushes)"},
      {"F,0.2,30,60,0.5,5,1,pulls,,-1", "line 2: initial_n = -1 (must be from 0"}};
  for (const auto& [row, words] : kinds) {
    const std::string sentence = sentence_of(with_kind + row);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
  }
}

// The stress in the wire by torsion alone, MPa.
double shear_mpa(const solver::StockSpring& spring, double force_n) {
  const double radius_mm = spring.wire_mm / 2, arm_mm = (spring.outer_mm - spring.wire_mm) / 2;
  const double polar_mm4 = std::numbers::pi / 2 * std::pow(radius_mm, 4);
  return force_n * arm_mm * radius_mm / polar_mm4;
}

// The twist of the wire by Castigliano's theorem gives the rate: U = M^2 l / (2 G J).
TEST(SpringTable, HasCommonSpringsOfWholeCoilsWithinTheirStrength) {
  int pushes = 0;
  for (const SpringRow& row : common_springs()) {
    const solver::StockSpring& spring = row.spring;
    const double arm_mm = (spring.outer_mm - spring.wire_mm) / 2;
    const double polar_mm4 = std::numbers::pi / 32 * std::pow(spring.wire_mm, 4);
    const double wire_mm = 81500 * polar_mm4 / (spring.rate_n_per_mm * arm_mm * arm_mm);
    const double coils = wire_mm / (2 * std::numbers::pi * arm_mm);
    // Rates have three digits.
    EXPECT_NEAR(coils, std::round(coils), 0.006 * coils) << row.name;
    EXPECT_GE(std::round(coils), 3) << row.name;
    const double largest_n = std::abs(spring.force_n(spring.limit_mm));
    // Torsion alone is less than with curvature, for which 0.45 of the strength is permitted.
    const double strength_mpa = 2211 * std::pow(spring.wire_mm, -0.145);
    EXPECT_LT(shear_mpa(spring, largest_n), 0.45 * strength_mpa) << row.name;
    if (spring.action == SpringAction::pushes) {
      ++pushes;
      EXPECT_GT(spring.limit_mm, (std::round(coils) + 2) * spring.wire_mm) << "solid";
      continue;
    }
    EXPECT_GT(shear_mpa(spring, largest_n), 0.3 * strength_mpa) << row.name;
    EXPECT_LE((std::round(coils) + 1) * spring.wire_mm + 2 * (spring.outer_mm - 2 * spring.wire_mm),
              spring.free_mm * 1.02)
        << row.name;
    EXPECT_LT(spring.initial_n, largest_n / 2) << row.name;
  }
  EXPECT_GE(pushes, 5);
}

}  // namespace
}  // namespace misalign::schema
