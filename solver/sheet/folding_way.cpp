#include "solver/sheet/folding_way.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "solver/kinematics/diagonals.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

using Eigen::Index;

namespace {

// The sheet's mirror image, on the other side of flat.
FoldState<double> mirrored(FoldState<double> state) {
  for (HalfAngle<double>& rho : state.creases) rho.s = -rho.s;
  for (Quaternion<double>& q : state.balls) q = {q.w, -q.x, -q.y, q.z};
  return state;
}

}  // namespace

double WayCoordinate::pilot_rad(double x) const {
  return limit_rad > 0 ? limit_rad * half_angle_of_rad(2 * x).s : x;
}

double WayCoordinate::pilot_rate(double x) const {
  return limit_rad > 0 ? limit_rad * half_angle_of_rad(2 * x).c : 1;
}

double WayCoordinate::x_of(double pilot_rad) const {
  assert(limit_rad >= 0);
  if (limit_rad <= 0) return pilot_rad;
  const double sine = std::clamp(pilot_rad / limit_rad, -1.0, 1.0);
  return angle_rad({std::sqrt((1 - sine) * (1 + sine)), sine}) / 2;
}

FoldingWay::FoldingWay(const Mechanism& mechanism, const FlatVertices& drawn_mm,
                       const WayCoordinate& coordinate, double step, double end,
                       std::vector<WayStation> stations)
    : mechanism_(&mechanism),
      a1_mm_(drawn_mm.col(0)),
      from_a1_mm_(drawn_mm.colwise() - a1_mm_),
      geometry_([&] {
        SheetGeometry<double> geometry;
        place(mechanism, drawn_mm, geometry);
        return geometry;
      }()),
      coordinate_(coordinate),
      step_(step),
      end_(end),
      stations_(std::move(stations)),
      flat_mm_(static_cast<Index>(mechanism.diagonals.size())),
      joints_(table_of_joints()) {
  assert(drawn_mm.cols() == mechanism.vertices);
  assert(step > 0 && end > 0);
  assert(end <= joints_.end() * (1 + 1e-9));
  flat_lengths(mechanism, geometry_, flat_mm_.data());
  flat_mm_ *= mechanism.panel_width_mm;
}

bool FoldingWay::ends_at_limit() const {
  return coordinate_.limit_rad > 0 && end_ >= (1 - 1e-12) * kPi / 2;
}

SmoothTable FoldingWay::table_of_joints() const {
  using Parity = SmoothTable::Parity;
  const Index count = static_cast<Index>(stations_.size());
  const Index joints = diagonals() + creases() + 4 * balls();
  Eigen::MatrixXd values(joints + odd_lengths(), count);
  for (Index k = 0; k < count; ++k) {
    const FoldState<double>& state = stations_[static_cast<std::size_t>(k)].state;
    assert(std::ssize(state.creases) == creases() && std::ssize(state.balls) == balls());
    assert(std::ssize(stations_[static_cast<std::size_t>(k)].rates) == mechanism_->unknowns);
    double* value = values.col(k).data();
    folded_lengths(*mechanism_, geometry_, state, value);
    for (Index d = 0; d < diagonals(); ++d) *value++ *= mechanism_->panel_width_mm;
    for (const HalfAngle<double>& rho : state.creases) *value++ = angle_rad(rho);
    for (const Quaternion<double>& q : state.balls) {
      for (const double entry : {q.w, q.x, q.y, q.z}) *value++ = entry;
    }
    if (odd_lengths() == 0) continue;
    auto lengths = values.col(k).head(diagonals()), odd = values.col(k).tail(diagonals());
    folded_lengths(*mechanism_, geometry_, mirrored(state), value);
    odd = 0.5 * (lengths - mechanism_->panel_width_mm * odd.eval());
    lengths -= odd;
  }
  std::vector<Parity> parities(static_cast<std::size_t>(diagonals()), Parity::even);
  parities.resize(static_cast<std::size_t>(diagonals() + creases()), Parity::odd);
  // The mirror image of a rotation in the sheet's plane reverses axes in the plane.
  for (Index ball = 0; ball < balls(); ++ball) {
    parities.insert(parities.end(), {Parity::even, Parity::odd, Parity::odd, Parity::even});
  }
  parities.resize(static_cast<std::size_t>(joints + odd_lengths()), Parity::odd);
  return table(values, std::move(parities));
}

void FoldingWay::find_lengths(double x, Eigen::VectorXd& lengths_mm,
                              Eigen::VectorXd& rates_mm) const {
  joints_.find(x, 0, diagonals(), lengths_mm, rates_mm);
  if (odd_lengths() == 0) return;
  joints_.find(x, diagonals() + creases() + 4 * balls(), diagonals(), odd_, odd_rates_);
  lengths_mm += odd_;
  rates_mm += odd_rates_;
}

void FoldingWay::find_creases(double x, Eigen::VectorXd& angles_rad, Eigen::VectorXd& rates) const {
  joints_.find(x, diagonals(), creases(), angles_rad, rates);
}

void FoldingWay::find_balls(double x, Eigen::VectorXd& speeds) const {
  joints_.find(x, diagonals() + creases(), 4 * balls(), quaternions_, quaternion_rates_);
  speeds.resize(balls());
  for (Index ball = 0; ball < balls(); ++ball) {
    speeds(ball) = 2 * quaternion_rates_.segment<4>(4 * ball).norm();
  }
}

std::optional<double> FoldingWay::over_folded_deg() const {
  constexpr double kBand_rad = kOverFoldBand_deg * kRadPerDeg;
  Eigen::VectorXd angles_rad, rates;
  const auto is_beyond = [&](double x) {
    find_creases(x, angles_rad, rates);
    return angles_rad.cwiseAbs().maxCoeff() > kPi + kBand_rad;
  };
  double below_x = 0, beyond_x = 0;
  for (std::size_t k = 0; k < stations_.size() && beyond_x == 0; ++k) {
    (is_beyond(x_of_station(k)) ? beyond_x : below_x) = x_of_station(k);
  }
  if (beyond_x == 0 && is_beyond(end_)) beyond_x = end_;
  if (beyond_x == 0) return {};
  assert(below_x < beyond_x);
  for (int k = 0; k < 50; ++k) {
    const double middle = (below_x + beyond_x) / 2;
    (is_beyond(middle) ? beyond_x : below_x) = middle;
  }
  return pilot_deg(below_x);
}

void FoldingWay::find_rates(double x, Eigen::VectorXd& rates) const {
  Eigen::VectorXd angles_rad, crease_rates;
  find_creases(x, angles_rad, crease_rates);
  rates.resize(mechanism_->unknowns);
  for (Index k = 0; k < creases(); ++k) {
    rates(mechanism_->creases[static_cast<std::size_t>(k)].column) = crease_rates(k);
  }
  joints_.find(x, diagonals() + creases(), 4 * balls(), quaternions_, quaternion_rates_);
  for (Index ball = 0; ball < balls(); ++ball) {
    const auto q = quaternions_.segment<4>(4 * ball), dq = quaternion_rates_.segment<4>(4 * ball);
    const Quaternion<double> turn = Quaternion<double>{dq(0), dq(1), dq(2), dq(3)} *
                                    Quaternion<double>{q(0), q(1), q(2), q(3)}.conjugate();
    rates.segment<3>(mechanism_->balls[static_cast<std::size_t>(ball)].column) << 2 * turn.x,
        2 * turn.y, 2 * turn.z;
  }
}

void FoldingWay::find_state(double x, FoldState<double>& state) const {
  assert(std::ssize(state.creases) == creases() && std::ssize(state.balls) == balls());
  const Index first = diagonals();
  for (Index k = 0; k < creases(); ++k) {
    state.creases[static_cast<std::size_t>(k)] = half_angle_of_rad(joints_.value(x, first + k));
  }
  joints_.find(x, first + creases(), 4 * balls(), quaternions_, quaternion_rates_);
  for (Index ball = 0; ball < balls(); ++ball) {
    const auto q = quaternions_.segment<4>(4 * ball);
    state.balls[static_cast<std::size_t>(ball)] =
        Quaternion<double>{q(0), q(1), q(2), q(3)}.normalized();
  }
}

}  // namespace misalign::solver
