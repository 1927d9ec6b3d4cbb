// Studies of Table 1 with rubber plates in its holes, against the Gram matrices of folded
// coordinates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <sstream>

#include "schema/exchange/history_table.hpp"
#include "schema/kit/kit_guide.hpp"
#include "search/sheets/card.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/release.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::search {
namespace {

using Eigen::Index;

constexpr double kPrestretch = 1.1, kShear_n_per_mm = 0.5;

schema::Design plates(double prestretch = kPrestretch) {
  schema::Design design;
  design.fill_kind = schema::FillKind::plate;
  design.prestretch = prestretch;
  return design;
}

class Plates : public testing::Test {
 protected:
  // Energy of all plates where the vertices are there. Pre-stretches from 1.1 on wrinkle nowhere.
  double gram_n_mm(const Eigen::Matrix3Xd& at_mm, double prestretch) const {
    const auto gram = [](const auto& a, const auto& b) {
      return Eigen::Matrix2d{{a.dot(a), a.dot(b)}, {a.dot(b), b.dot(b)}};
    };
    double sum = 0;
    for (const int hole : subject_.sheet.base().holes) {
      const auto& v = subject_.sheet.base().sheet.facets[static_cast<std::size_t>(hole)];
      const Eigen::Vector3d now[2] = {at_mm.col(v[2]) - at_mm.col(v[0]),
                                      at_mm.col(v[3]) - at_mm.col(v[1])};
      const Eigen::Vector3d flat[2] = {flat_mm_.col(v[2]) - flat_mm_.col(v[0]),
                                       flat_mm_.col(v[3]) - flat_mm_.col(v[1])};
      const double area_mm2 = flat[0].cross(flat[1]).norm() / 2 / (prestretch * prestretch);
      const Eigen::Matrix2d c =
          gram(flat[0], flat[1]).inverse() * gram(now[0], now[1]) * (prestretch * prestretch);
      sum += kShear_n_per_mm * area_mm2 / 2 * (c.trace() + 1 / c.determinant() - 3);
    }
    return sum;
  }
  double gram_n_mm(Index row, double prestretch = kPrestretch) const {
    return gram_n_mm(
        row == 0 ? flat_mm_ : subject_.sheet.shapes_mm()[static_cast<std::size_t>(row - 1)],
        prestretch);
  }

  static Eigen::Matrix3Xd flat_of(const solver::Sheet& sheet) {
    Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, sheet.vertices_mm().cols());
    flat_mm.topRows<2>() = sheet.vertices_mm();
    return flat_mm;
  }

  const Subject subject_{sheet_of_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json"),
                         plates()};
  const Eigen::Matrix3Xd flat_mm_ = flat_of(subject_.sheet);
  const solver::Actuation actuation_ = actuated(subject_.sheet, subject_.model.design());
};

// Folded coordinates carry the solver's 1e-10 mm; energies 1e-9 of hundreds of N mm.
TEST_F(Plates, HaveTheEnergyOfTheirShapes) {
  const schema::Json json = study_json(subject_, actuation_);
  EXPECT_EQ(json["fill"]["kind"], "plate");
  EXPECT_EQ(json["fill"]["prestretch"], kPrestretch);
  EXPECT_FALSE(json.contains("stiffness_n_per_mm"));
  EXPECT_TRUE(json["few"].is_null()) << "a plate's diagonals are not apart";
  const auto energy_n_mm = json["history"]["energy_n_mm"].get<std::vector<double>>();
  const auto moment_n_mm = json["history"]["moment_n_mm"].get<std::vector<double>>();
  ASSERT_GT(energy_n_mm.size(), 150u);
  for (const Index row : {0, 10, 36, 90, 150}) {
    const auto at = static_cast<std::size_t>(row);
    EXPECT_NEAR(energy_n_mm[at], gram_n_mm(row), 1e-7) << row;
    if (row == 0) continue;
    // Differences of the fourth order, next to the path's end some 1e-4 off.
    const double slope = (8 * (gram_n_mm(row + 1) - gram_n_mm(row - 1)) -
                          (gram_n_mm(row + 2) - gram_n_mm(row - 2))) /
                         (12 * solver::kRadPerDeg);
    EXPECT_NEAR(moment_n_mm[at] / slope, 1, 5e-4) << row;
  }
  // The prototype's 1.93 and 12.9 N mm above flat (drawn from a membrane, within 1.5 %).
  EXPECT_NEAR(energy_n_mm[36] - energy_n_mm[0], 1.93, 0.03);
  EXPECT_NEAR(energy_n_mm[90] - energy_n_mm[0], 12.9, 0.2);
}

// Halves of each hole's energy.
TEST_F(Plates, AreDividedAmongTheDiagonalsOfTables) {
  const schema::FoldingView view(subject_.chosen.base, subject_.sheet);
  std::istringstream rows(schema::diagonal_rows({"draw", "7"}, view, actuation_, 36));
  double sum_n_mm = 0;
  for (std::string line; std::getline(rows, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (cells[1] == "36") sum_n_mm += std::stod(cells[10]);
  }
  EXPECT_NEAR(sum_n_mm, gram_n_mm(Index{36}), 1e-6);
}

// The least ratio of released energy to turning, at samples.
TEST_F(Plates, DeployAgainstFriction) {
  const solver::ReleaseOptions options = deploy_options(subject_.model.design(), subject_.sheet);
  const solver::DeploymentStudy study = deployed(subject_.sheet, options);
  const solver::Mechanism& mechanism = subject_.sheet.mechanism();
  const Eigen::MatrixXd& folds_deg = subject_.sheet.history().fold_angle_deg;
  const auto turned_mm = [&](Index row) {
    double sum = 0;
    for (std::size_t c = 0; c < mechanism.creases.size(); ++c) {
      const solver::Crease& crease = mechanism.creases[c];
      const double length_mm = (flat_mm_.col(crease.a) - flat_mm_.col(crease.b)).norm();
      sum += length_mm *
             (std::abs(folds_deg(35, static_cast<Index>(c))) -
              (row == 0 ? 0 : std::abs(folds_deg(row - 1, static_cast<Index>(c))))) *
             solver::kRadPerDeg;
    }
    return sum;
  };
  double least = INFINITY;
  for (Index row = 0; row < 36; ++row) {
    least = std::min(least, (gram_n_mm(Index{36}) - gram_n_mm(row)) / turned_mm(row));
  }
  // Flat is the worst place here, and a sample.
  EXPECT_NEAR(*study.friction.critical_n_mm_per_mm / least, 1, 1e-6);
  EXPECT_FALSE(study.friction.stiffness_needed_n_per_mm);
  const std::string text = deployment_text(mechanism, study);
  EXPECT_NE(text.find("rubber plates of 1 mm, shear modulus 0.5 MPa, pre-stretched by 1.1"),
            std::string::npos);
  EXPECT_EQ(text.find("spring"), std::string::npos) << text;
  const schema::Json json = study_json(subject_, ReleasedSheet{study, {}, {}});
  EXPECT_EQ(json["fill"]["shear_mpa"], 0.5);
  EXPECT_FALSE(json.contains("springs"));
}

TEST_F(Plates, AreNamedInTextsAndKits) {
  const std::string text = actuators_text(subject_.sheet, actuation_);
  EXPECT_TRUE(text.starts_with("rubber plates of 1 mm")) << text;
  EXPECT_EQ(text.find("spring"), text.find("worth springs") + 6) << text;  // the equivalent ones
  const schema::KitOptions options;
  const schema::Kit kit = schema::kit_of(subject_.sheet, options, "a kit");
  const std::string guide = schema::kit_guide(
      {subject_.sheet, options, kit, subject_.model.design(), actuation_, nullptr, "a kit"});
  EXPECT_NE(guide.find("<h2>Rubber plates</h2>"), std::string::npos);
  EXPECT_EQ(guide.find("pring"), std::string::npos);
  // The cut-out of the first hole.
  const auto& v = subject_.sheet.base()
                      .sheet.facets[static_cast<std::size_t>(subject_.sheet.base().holes.front())];
  const double first_mm = (flat_mm_.col(v[3]) - flat_mm_.col(v[1])).norm() / kPrestretch,
               second_mm = (flat_mm_.col(v[2]) - flat_mm_.col(v[0])).norm() / kPrestretch;
  EXPECT_NE(guide.find(fmt::format("{:.2f} × {:.2f}", first_mm, second_mm)), std::string::npos);
}

// Sample by sample the energy of more stretched plates turns at 156 degrees, where all diagonals
// are monotone; that of others does not turn.
TEST_F(Plates, AreJudgedByTheirEnergy) {
  constexpr double kMore = 1.3;
  ASSERT_LT(gram_n_mm(Index{154}, kMore), gram_n_mm(Index{155}, kMore));
  ASSERT_LT(gram_n_mm(Index{156}, kMore), gram_n_mm(Index{155}, kMore));
  ASSERT_LT(gram_n_mm(Index{155}), gram_n_mm(Index{156}));
  const auto falls_from = [](double prestretch, double from_deg) {
    schema::Design design = plates(prestretch);
    design.from_deg = from_deg;
    const Subject subject(sheet_of_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json"),
                          design);
    const schema::Card card = card_of(subject, {}).card;
    const auto line = [&](const std::string& key) {
      return std::ranges::find_if(card.lines,
                                  [&](const schema::CardLine& other) { return other.key == key; });
    };
    EXPECT_EQ(line("least_stroke_mm"), card.lines.end());
    EXPECT_EQ(line("useful_stiffness_n_per_mm"), card.lines.end());
    EXPECT_EQ(line("spring_clearance_mm"), card.lines.end());
    return *line("energy_falls_from_deg");
  };
  for (const double from_deg : {150.0, 156.0}) {
    const schema::CardLine line = falls_from(kMore, from_deg);
    EXPECT_EQ(line.passes(), from_deg == 150);
    EXPECT_EQ(line.found, 155);
  }
  EXPECT_EQ(falls_from(kPrestretch, 156).found, 156);
}

TEST_F(Plates, AreRefusedByOtherPrograms) {
  const auto refusal = [](const auto& study) -> std::string {
    try {
      study();
    } catch (const schema::UserError& error) {
      EXPECT_EQ(error.cause(), schema::Cause::bad_request);
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal([&] {
              release(subject_.model, subject_.sheet, {}, "it");
            }).find("simulations by other programs"),
            std::string::npos);
  EXPECT_NE(refusal([&] { optimised(subject_, {}); }).find("optimise"), std::string::npos);
}

// Preload is part of the energy that a table gives to a spring: k / 2 (L - L0)^2.
TEST(Springs, WithPreloadHaveTheirEnergyInTables) {
  schema::Design design;
  design.preload_n = 10;
  const Subject subject(sheet_of_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json"),
                        design);
  const solver::Actuation actuation = actuated(subject.sheet, subject.model.design());
  const schema::FoldingView view(subject.chosen.base, subject.sheet);
  std::istringstream rows(schema::diagonal_rows({"draw", "7"}, view, actuation, 36));
  int checked = 0;
  for (std::string line; std::getline(rows, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    const double force_n = std::stod(cells[9]), n_mm = force_n * force_n / (2 * 50);
    EXPECT_NEAR(std::stod(cells[10]), n_mm, 1e-7 * n_mm) << "nine digits";
    ++checked;
  }
  EXPECT_GE(checked, 2 * 16);
}

}  // namespace
}  // namespace misalign::search
