// Table 1 with eight rubber plates let go from 36 degrees, against vertex coordinates and a
// quadrature: nothing here knows a pose, a joint or the program's plates.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>

#include "solver/motion/deploy.hpp"
#include "tests/solver/coordinate_mass.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"
#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::solver {
namespace {

using Eigen::Matrix3Xd;

constexpr double kFrom_deg = 36, kFrom_rad = kFrom_deg * kRadPerDeg;

// Energy of the mean deformations of all plates: 0.5 MPa, 1 mm.
double plates_n_mm(const Mechanism& mechanism, const FlatVertices& flat_mm, const Matrix3Xd& at_mm,
                   double prestretch) {
  double energy = 0;
  for (std::size_t d = 0; d < mechanism.diagonals.size(); d += 2) {
    const Diagonal &one = mechanism.diagonals[d], &other = mechanism.diagonals[d + 1];
    Eigen::Matrix2d rest;
    rest << flat_mm.col(one.to) - flat_mm.col(one.from),
        flat_mm.col(other.to) - flat_mm.col(other.from);
    rest /= prestretch;
    Eigen::Matrix<double, 3, 2> now;
    now << at_mm.col(one.to) - at_mm.col(one.from), at_mm.col(other.to) - at_mm.col(other.from);
    const Eigen::Vector2d s =
        Eigen::JacobiSVD<Eigen::MatrixXd>(now * rest.inverse()).singularValues();
    const double across = std::max(s(1), 1 / std::sqrt(s(0)));  // wrinkles hide the rest
    energy += 0.25 * std::abs(rest.determinant()) / 2 *
              (s(0) * s(0) + across * across + std::pow(s(0) * across, -2) - 3);
  }
  return energy;
}

// mass / 2 (d rho / dt)^2 = E(from) - E, by the midpoint rule in u with rho = from (1 - u^2), in
// which nothing is singular at the start, twice, and Richardson's extrapolation of the two.
TEST(RubberRelease, IsFlatWhenCoordinatesSayIt) {
  const TestSheet sheet(6, 6);
  const FlatVertices vertices_mm = sheet.shifted(golden("table1_odd.json")["displacements_mm"]);
  const OwnSheet own(sheet.base, vertices_mm - sheet.base.sheet.vertices_mm);
  const FoldingWay& way = *own.sheet.way();
  FoldState<double> state = way.stations().front().state;
  constexpr int kSteps = 24;
  constexpr double kFirst_deg = 0.1, kStep_rad = 1e-4;
  way.find_state(way.x_of(kFirst_deg), state);
  VertexCoordinates coordinates(sheet.base, vertices_mm,
                                own.model.shape().vertices_mm(way.geometry(), state), kFirst_deg);
  struct Place {
    double u, mass;
    Matrix3Xd here_mm;
  };
  std::vector<Place> places;
  std::vector<double> middles;
  for (const int steps : {kSteps / 2, kSteps}) {
    for (int i = 0; i < steps; ++i) middles.push_back((i + 0.5) / steps);
  }
  std::ranges::sort(middles, std::greater());
  for (const double u : middles) {
    const double deg = kFrom_deg * (1 - u * u), beside_deg = kStep_rad / 2 / kRadPerDeg;
    Matrix3Xd shapes_mm[3];
    for (const int side : {-1, 0, 1}) {
      ASSERT_TRUE(coordinates.fold_to(deg + side * beside_deg));
      shapes_mm[side + 1] = coordinates.points_mm();
    }
    places.push_back(
        {u, mass_of_coordinates(sheet.base, Plates{}, shapes_mm[0], shapes_mm[2], kStep_rad),
         shapes_mm[1]});
  }
  ASSERT_TRUE(coordinates.fold_to(kFrom_deg));
  const Matrix3Xd start_mm = coordinates.points_mm();
  for (const double prestretch : {1.0, 1.1}) {
    const auto energy = [&](const Matrix3Xd& at_mm) {
      return plates_n_mm(sheet.mechanism, vertices_mm, at_mm, prestretch);
    };
    double times_s[2];
    for (const int finer : {0, 1}) {
      const int steps = finer ? kSteps : kSteps / 2;
      double& time_s = times_s[finer] = 0;
      for (int i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps;
        const auto is_here = [&](const Place& place) { return std::abs(place.u - u) < 1e-12; };
        const Place& place = *std::ranges::find_if(places, is_here);
        time_s += 2 * kFrom_rad * u / steps *
                  std::sqrt(place.mass / 2 / (energy(start_mm) - energy(place.here_mm)));
      }
    }
    const double time_s = times_s[1] + (times_s[1] - times_s[0]) / 3;
    RubberPlates plates;
    plates.prestretch = prestretch;
    EnergyModel::Options energy_options;
    energy_options.fill = plates;
    const auto study = study_deployment(own.sheet, energy_options, {.from_deg = kFrom_deg});
    ASSERT_TRUE(study.deploy_time_s());
    RecordProperty("time_ms_" + std::to_string(std::lround(100 * prestretch)), scientific(time_s));
    // The extrapolation leaves an error of 1e-5.
    EXPECT_NEAR(*study.deploy_time_s() / time_s, 1, 1e-5) << prestretch;
    EXPECT_NEAR(study.run.rows.front().springs_n_mm, energy(start_mm), 1e-8 * energy(start_mm));
  }
}

}  // namespace
}  // namespace misalign::solver
