#include "solver/verdict/energy_judge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace misalign::solver {
namespace {

// Relative rounding error of a plate's energy, by its stiffness times its diagonals' squares: of
// sums that cancel where it is relaxed.
constexpr double kPlateRounding = 1e-15;

// Returns whether a filling depends on which diagonals lengthen next to flat.
bool depends_on_sides(const Fill& fill) {
  const auto* const springs = std::get_if<Springs>(&fill);
  return springs && (springs->preload.is_any() || springs->on != SpringsOn::all);
}

auto in_mm(const std::vector<double>& widths, double width_mm) {
  return width_mm * Eigen::VectorXd::Map(widths.data(), std::ssize(widths));
}

}  // namespace

void DriveRatio::take(const Bounded& has, const Bounded& needs) {
  if (!(needs.high() > 0)) return;
  low = std::min(low, has.low() / (has.low() > 0 ? needs.high() : std::max(needs.low(), 1e-300)));
  if (needs.low() > 0) {
    high = std::min(high, has.high() / (has.high() > 0 ? needs.low() : needs.high()));
  }
  if (needs.value > 0) value = std::min(value, has.value / needs.value);
}

std::optional<bool> DriveRatio::is_met() const {
  if (low >= 1) return true;
  if (high < 1) return false;
  return std::nullopt;
}

DriveRatio friction_ratio(const DrivenSample& now, const std::vector<DrivenSample>& before,
                          double friction_n_mm_per_mm, DriveRatio least) {
  for (const DrivenSample& below : before) {
    least.take({now.energy_n_mm.value - below.energy_n_mm.value,
                now.energy_n_mm.error + below.energy_n_mm.error},
               {friction_n_mm_per_mm * (now.turning_mm.value - below.turning_mm.value),
                friction_n_mm_per_mm * (now.turning_mm.error + below.turning_mm.error)});
  }
  return least;
}

EnergyJudge::EnergyJudge(const Mechanism& mechanism, const EnergyCriterion& criterion)
    : mechanism_(mechanism),
      criterion_(criterion),
      width_mm_(mechanism.panel_width_mm),
      needs_sides_(depends_on_sides(criterion.fill)),
      lengths_(mechanism.diagonals.size()),
      last_lengths_(lengths_),
      errors_(lengths_),
      last_errors_(lengths_),
      forces_n_(lengths_),
      last_forces_n_(lengths_),
      stiffness_n_per_mm_(lengths_) {
  assert(rest_deg(criterion.fill) == 0);
  creases_mm_.reserve(mechanism.creases.size());
}

void EnergyJudge::begin(const std::vector<double>& flat_lengths,
                        const SheetGeometry<double>* geometry) {
  holes_.flat_mm = holes_.rest_mm = in_mm(flat_lengths, width_mm_);
  holes_.sides.setZero(holes_.flat_mm.size());
  if (std::holds_alternative<RubberPlates>(criterion_.fill)) {
    assert(geometry);
    vertices_mm_.resize(2, std::ssize(geometry->x));
    vertices_mm_.row(0) = in_mm(geometry->x, width_mm_);
    vertices_mm_.row(1) = in_mm(geometry->y, width_mm_);
    find_diagonal_products(mechanism_, vertices_mm_, holes_.product_mm2);
  }
  filling_.fit(criterion_.fill, mechanism_.diagonals, holes_);
  if (asks_for_turning()) {
    assert(geometry);
    find_crease_lengths(mechanism_, *geometry, creases_mm_);
    all_creases_mm_ = std::accumulate(creases_mm_.begin(), creases_mm_.end(), 0.0);
  }
  last_lengths_ = flat_lengths;
  std::ranges::fill(last_errors_, 0.0);
  samples_.clear();
  samples_.push_back({energy_at(flat_lengths, nullptr, last_forces_n_), {}});
  moment_ = moment_now_ = {};
}

Bounded EnergyJudge::energy_at(const std::vector<double>& lengths,
                               const std::vector<double>* errors, std::vector<double>& forces_n) {
  assert(std::ssize(lengths) == filling_.diagonals());
  Bounded energy;
  for (Eigen::Index h = 0; h < filling_.holes(); ++h) {
    const std::size_t first = 2 * static_cast<std::size_t>(h);
    const HoleEnergy hole =
        filling_.hole(h, {lengths[first] * width_mm_, lengths[first + 1] * width_mm_});
    energy.value += hole.n_mm;
    for (int k = 0; k < 2; ++k) {
      const std::size_t d = first + static_cast<std::size_t>(k);
      forces_n[d] = hole.force_n(k);
      // The rate of a spring bounds the change of its force, slack or not.
      stiffness_n_per_mm_[d] = filling_.is_springs() ? filling_.rates_n_per_mm()(2 * h + k)
                                                     : hole.n_per_mm.row(k).cwiseAbs().sum();
    }
  }
  for (std::size_t d = 0; d < lengths.size(); ++d) {
    if (errors) {
      const double error_mm = (*errors)[d] * width_mm_;
      energy.error += (std::abs(forces_n[d]) + stiffness_n_per_mm_[d] * error_mm) * error_mm;
    }
    if (!filling_.is_springs()) {
      const double length_mm = lengths[d] * width_mm_;
      energy.error += kPlateRounding * stiffness_n_per_mm_[d] * length_mm * length_mm;
    }
  }
  return energy;
}

void EnergyJudge::look(const std::vector<double>& lengths, const std::vector<double>* errors) {
  assert(!samples_.empty() && "a path is begun");
  lengths_ = lengths;
  std::ranges::fill(errors_, 0.0);
  if (errors) errors_ = *errors;
  if (samples_.size() == 1 && needs_sides_) set_sides(lengths);
  now_ = {energy_at(lengths_, errors, forces_n_), {}};
  moment_now_ = moment_;
  band_n_mm_ = 0;
  for (const double force_n : forces_n_) {
    band_n_mm_ += std::abs(force_n) * kStepBand_widths * width_mm_;
  }
  pulls_back_ = -1;
  is_sure_who_ = true;
  if (!rises()) find_who_pulls_back();
}

void EnergyJudge::set_sides(const std::vector<double>& first_lengths) {
  holes_.sides = (in_mm(first_lengths, width_mm_) - holes_.flat_mm).cwiseSign();
  filling_.fit(criterion_.fill, mechanism_.diagonals, holes_);
  samples_.front().energy_n_mm = energy_at(last_lengths_, nullptr, last_forces_n_);
}

// The work of springs between two samples is the mean of their forces times the step.
void EnergyJudge::find_who_pulls_back() {
  double most = std::numeric_limits<double>::infinity(), next = most, error = 0;
  for (std::size_t d = 0; d < lengths_.size(); ++d) {
    const double step_mm = (lengths_[d] - last_lengths_[d]) * width_mm_;
    const double mean_n = (forces_n_[d] + last_forces_n_[d]) / 2, work_n_mm = mean_n * step_mm;
    const double off_mm = (errors_[d] + last_errors_[d]) * width_mm_;
    error = std::max(
        error, off_mm * (std::abs(mean_n) + stiffness_n_per_mm_[d] * (std::abs(step_mm) + off_mm)));
    next = std::min(next, std::max(most, work_n_mm));
    if (work_n_mm >= most) continue;
    most = work_n_mm;
    pulls_back_ = static_cast<int>(d);
  }
  is_sure_who_ = next - most > 2 * error;
}

bool EnergyJudge::is_decisive() const {
  const double error_n_mm = now_.energy_n_mm.error + samples_.back().energy_n_mm.error;
  if (error_n_mm > 0 && std::abs(step_n_mm() - band_n_mm_) <= error_n_mm + 0.1 * band_n_mm_) {
    return false;
  }
  if (samples_.size() == 1 && needs_sides_) {
    for (std::size_t d = 0; d < lengths_.size(); ++d) {
      const double change = std::abs(lengths_[d] - last_lengths_[d]);
      if (change <= kStepBand_widths + errors_[d]) return false;
    }
  }
  return rises() || is_sure_who_;
}

LeastPart EnergyJudge::missed_part() const {
  LeastPart part;
  if (const std::size_t count = samples_.size(); count >= 2) {
    const Bounded &last = samples_[count - 1].energy_n_mm,
                  &before = samples_[count - 2].energy_n_mm;
    const double forward = last.value - before.value, back = std::max(-step_n_mm(), 0.0);
    const double error = last.error + std::max(before.error, now_.energy_n_mm.error);
    if (forward + back > 0) {
      part.add(turning_part(forward, back), turning_part_error(forward, back, error));
      return part;
    }
  }
  part.add(0);
  return part;
}

void EnergyJudge::set_creases(const std::vector<HalfAngle<double>>& creases, double error) {
  if (!asks_for_turning()) return;
  // An angle is twice that of sine and cosine, each of which may be off.
  now_.turning_mm = {turning_mm(creases_mm_, creases), 4 * error * all_creases_mm_};
}

void EnergyJudge::set_slopes(const std::vector<double>& slopes, double relative_error) {
  if (!asks_for_moment()) return;
  assert(slopes.size() == forces_n_.size());
  double moment_n_mm = 0, forces_sq = 0, slopes_sq = 0;
  for (std::size_t d = 0; d < slopes.size(); ++d) {
    moment_n_mm += forces_n_[d] * slopes[d] * width_mm_;
    forces_sq += forces_n_[d] * forces_n_[d];
    slopes_sq += slopes[d] * slopes[d] * width_mm_ * width_mm_;
  }
  moment_now_ = moment_;
  moment_now_.take({moment_n_mm, relative_error * std::sqrt(forces_sq * slopes_sq)},
                   {criterion_.least_moment_n_mm});
}

DriveRatio EnergyJudge::drive() const {
  if (!asks_for_turning()) return moment_now_;
  return friction_ratio(now_, samples_, criterion_.least_friction_n_mm_per_mm, moment_now_);
}

void EnergyJudge::take() {
  samples_.push_back(now_);
  moment_ = moment_now_;
  std::swap(last_lengths_, lengths_);
  std::swap(last_errors_, errors_);
  std::swap(last_forces_n_, forces_n_);
}

void EnergyJudge::correct_last(const std::vector<double>& lengths,
                               const std::vector<double>* errors) {
  last_lengths_ = lengths;
  if (errors) last_errors_ = *errors;
  samples_.back().energy_n_mm = energy_at(last_lengths_, errors, last_forces_n_);
}

}  // namespace misalign::solver
