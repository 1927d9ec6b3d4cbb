#include "solver/verdict/verdict.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {

Judge::Judge(const Mechanism& mechanism, const Criterion& criterion)
    : mechanism_(mechanism), criterion_(criterion) {
  if (!criterion.energy) return;
  assert(criterion.bumps == BumpRule::ignored);
  energy_.emplace(mechanism, *criterion.energy);
}

void Judge::begin(const std::vector<double>& flat_lengths, const SheetGeometry<double>* geometry) {
  assert(std::ssize(flat_lengths) == mechanism_.diagonal_count());
  samples_in_order_ = 0;
  last_pilot_deg_ = 0;
  last_pilot_rate_ = 0;  // flat: all branches meet there
  fault_ = Fault::none;
  where_ = -1;
  missed_part_ = 0;
  last_ = before_last_ = least_ = most_ = flat_lengths;
  direction_.assign(flat_lengths.size(), 0);
  back_since_deg_.assign(flat_lengths.size(), 0);
  last_slopes_.assign(flat_lengths.size(), 0);  // lengths begin like the square of the angle
  between_ = {};
  if (energy_) energy_->begin(flat_lengths, geometry);
}

bool Judge::see(const Station& station, const FoldState<double>* state,
                const std::vector<double>& lengths, const std::vector<double>* slopes,
                double pilot_rate) {
  assert(lengths.size() == last_.size());
  assert(station.pilot_deg > last_pilot_deg_ || fault_ != Fault::none);  // samples ascend
  if (!is_in_order(state, lengths)) return false;
  if (slopes) {
    const Between between = seen_between(station, lengths, *slopes, pilot_rate);
    if (criterion_.bumps == BumpRule::by_cubic && between.back_where >= 0) {
      const auto where = static_cast<std::size_t>(between.back_where);
      end_between(between.back_where, (*slopes)[where], between.back_deg);
      return false;
    }
    if (criterion_.finds_soft_stop(station.sample, *slopes)) {
      end(Fault::soft_stop, -1, criterion_.stop_part(*slopes));
      return false;
    }
    between_ = between;
    if (criterion_.bumps == BumpRule::exact)
      between_.bump_where = -1;  // no bump, since it would have ended D
    last_slopes_ = *slopes;
    last_pilot_rate_ = pilot_rate;
  }
  if (energy_ && !drives_enough(station, state, slopes)) return false;
  take(station, lengths);
  return true;
}

// Judges the margins where the next sample is the threshold.
bool Judge::drives_enough(const Station& station, const FoldState<double>* state,
                          const std::vector<double>* slopes) {
  if (station.sample > energy_->from_sample()) return true;
  assert(state || !energy_->asks_for_turning());
  if (state) energy_->set_creases(state->creases);
  assert(slopes || !energy_->asks_for_moment());
  if (slopes && station.pilot_deg >= kInactiveFrom_deg) energy_->set_slopes(*slopes);
  if (station.sample < energy_->from_sample()) return true;
  const double ratio = energy_->drive().value;
  if (ratio >= 1) return true;
  end(Fault::weak_drive, -1, ratio);
  return false;
}

void Judge::end_between(int where, double rate, double from_deg) {
  assert(where >= 0 && where < mechanism_.diagonal_count());
  end(goes_back(where, rate) ? Fault::reverses_between : Fault::bump, where,
      part_at(from_deg).value());
  if (fault_ != Fault::bump) return;
  between_.bump_where = where;
  between_.bump_deg = from_deg;
}

bool Judge::is_in_order(const FoldState<double>* state, const std::vector<double>& lengths,
                        const std::vector<double>* errors) {
  assert(!state || state->creases.size() == mechanism_.creases.size());
  if (fault_ != Fault::none) return false;
  fault_ = fault_in(state, lengths, errors, where_);
  if (fault_ == Fault::none) return true;
  if (criterion_.scores) missed_part_ = missed_part(state, lengths).value();
  return false;
}

void Judge::take(const Station& station, const std::vector<double>& lengths) {
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    least_[i] = std::min(least_[i], lengths[i]);
    most_[i] = std::max(most_[i], lengths[i]);
  }
  if (energy_) energy_->take();
  std::swap(last_, before_last_);
  last_ = lengths;
  ++samples_in_order_;
  last_pilot_deg_ = station.pilot_deg;
}

Fault Judge::fault_in(const FoldState<double>* state, const std::vector<double>& lengths,
                      const std::vector<double>* errors, int& where) {
  if (state) {
    const Fault fault = fault_of_creases(*state, where);
    if (fault != Fault::none) return fault;
  }
  int reverses = -1;
  const bool steps_back = longest_step_back(lengths, reverses) > 0;
  if (!energy_) {
    if (steps_back) where = reverses;
    return steps_back ? Fault::not_monotone : Fault::none;
  }
  energy_->look(lengths, errors);
  if (energy_->rises()) return Fault::none;
  where = energy_->pulls_back();
  return Fault::energy_rises;
}

Fault Judge::fault_of_creases(const FoldState<double>& state, int& where) const {
  const int creases = static_cast<int>(mechanism_.creases.size());
  for (int i = 0; i < creases; ++i) {
    if (state.creases[i].c < kLeastCosine) {
      where = i;
      return Fault::over_folded;
    }
  }
  for (int i = 0; i < creases; ++i) {
    if (!(state.creases[i].s * mechanism_.creases[i].assignment > 0)) {
      where = i;
      return Fault::assignment_flipped;
    }
  }
  return Fault::none;
}

// Sets the directions of diagonals, too.
double Judge::longest_step_back(const std::vector<double>& lengths, int& where) {
  double largest_step_back = 0;
  for (int i = 0; i < mechanism_.diagonal_count(); ++i) {
    const double step = lengths[i] - last_[i];
    if (std::abs(step) < kStepBand_widths) continue;
    const int sign = step > 0 ? 1 : -1;
    if (direction_[i] == 0) direction_[i] = sign;
    if (direction_[i] != sign && std::abs(step) > largest_step_back) {
      largest_step_back = std::abs(step);
      where = i;
    }
  }
  return largest_step_back;
}

LeastPart Judge::missed_part(const FoldState<double>* state, const std::vector<double>& lengths,
                             const std::vector<double>* step_errors, double crease_error) const {
  LeastPart part;
  if (samples_in_order_ == 0) {
    part.add(0);
    return part;
  }
  if (fault_ == Fault::over_folded || fault_ == Fault::assignment_flipped) {
    assert(state);  // a fault of creases was seen in it
    for (std::size_t i = 0; i < mechanism_.creases.size(); ++i) {
      const HalfAngle<double>& rho = state->creases[i];
      const double excess = fault_ == Fault::over_folded
                                ? kLeastCosine - rho.c
                                : -rho.s * mechanism_.creases[i].assignment;
      if (excess < 0) continue;
      part.add(excess_part(excess, sample_rad()), crease_error / std::sin(sample_rad() / 2));
    }
    return part;
  }
  if (energy_) return energy_->missed_part();
  // If turns between samples are faults, parts count from D, not from half a sample before.
  const double earlier = criterion_.bumps == BumpRule::ignored ? 0 : 0.5;
  for (int i = 0; i < mechanism_.diagonal_count(); ++i) {
    const double step = lengths[i] - last_[i];
    if (std::abs(step) < kStepBand_widths || !goes_back(i, step)) continue;
    const double forward = (last_[i] - before_last_[i]) * direction_[i], back = std::abs(step);
    part.add(turning_part(forward, back) - earlier,
             step_errors ? turning_part_error(forward, back, (*step_errors)[i]) : 0);
  }
  return part;
}

// Distance of samples.
double Judge::sample_rad() const {
  return last_pilot_deg_ * kRadPerDeg / std::max(samples_in_order_, 1);
}

int Judge::score(const PathResult& path) const {
  const double part = fault_ == Fault::none ? limit_part(path).value() : missed_part_;
  return kScoresPerSample * samples_in_order_ + scores_of(part);
}

LeastPart Judge::part_at(double pilot_deg, double error_rad) const {
  LeastPart part;
  if (samples_in_order_ == 0) {
    part.add(0);
  } else {
    part.add((pilot_deg - last_pilot_deg_) * kRadPerDeg / sample_rad(), error_rad / sample_rad());
  }
  return part;
}

LeastPart Judge::limit_part(const PathResult& path, double error_rad) const {
  return path.end == PathEnd::fold_limit ? part_at(path.fold_limit_deg, error_rad)
                                         : part_at(last_pilot_deg_);
}

Between Judge::seen_between(const Station& station, const std::vector<double>& lengths,
                            const std::vector<double>& slopes, double pilot_rate) {
  const double step_deg = station.pilot_deg - last_pilot_deg_;
  const double slowing = last_pilot_rate_ > 0 && pilot_rate > 0 ? pilot_rate / last_pilot_rate_ : 1;
  Between between = between_;
  double longest = 0, longest_bump = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (direction_[i] == 0) continue;
    if (last_pilot_deg_ == 0 && !mechanism_.springs.in_mid_plane()) {
      last_slopes_[i] = slope_at_flat(lengths[i] - last_[i], slopes[i], step_deg * kRadPerDeg);
    }
    const BetweenSamples seen = look_between({last_[i], last_slopes_[i]}, {lengths[i], slopes[i]},
                                             step_deg * kRadPerDeg, slowing, direction_[i]);
    if (last_pilot_deg_ >= kInactiveFrom_deg) {
      between.least_slope = std::min(between.least_slope, seen.least_slope);
    }
    const bool goes_on = slopes[i] * direction_[i] >= 0;
    double from_deg = last_pilot_deg_ + seen.from * step_deg;
    if (back_since_deg_[i] > 0) from_deg = back_since_deg_[i];
    back_since_deg_[i] = goes_on ? 0 : from_deg;
    if (seen.back < kBumpBand_widths) continue;
    if (between_.back_where < 0 && seen.back > longest) {
      longest = seen.back;
      between.back_deg = from_deg;
      between.back_where = static_cast<int>(i);
    }
    if (between_.bump_where < 0 && goes_on && seen.back > longest_bump) {
      longest_bump = seen.back;
      between.bump_deg = from_deg;
      between.bump_where = static_cast<int>(i);
    }
  }
  return between;
}

double Judge::least_span() const {
  double least = std::numeric_limits<double>::infinity();
  if (energy_ || last_pilot_deg_ < kInactiveFrom_deg) return least;
  for (std::size_t i = 0; i < least_.size(); ++i) least = std::min(least, most_[i] - least_[i]);
  return least;
}

// Inactivity comes first: a sheet with an inactive diagonal has D = 0, wherever its path is lost.
Verdict Judge::conclude(const PathResult& path) const {
  const bool judges_activity = !energy_ && last_pilot_deg_ >= kInactiveFrom_deg;
  for (int i = 0; judges_activity && i < mechanism_.diagonal_count(); ++i) {
    if (most_[i] - least_[i] < kInactiveBand_widths) {
      return {0, Fault::inactive_diagonal, i, path.end};
    }
  }
  Verdict verdict{samples_in_order_, fault_, where_, path.end};
  if (fault_ == Fault::undecided) {
    verdict.path_end = PathEnd::stalled;
    return verdict;
  }
  if (fault_ == Fault::none) {
    if (path.lost()) {
      verdict.first_fault = Fault::undecided;
      return verdict;
    }
    if (path.end == PathEnd::fold_limit) verdict.first_fault = Fault::fold_limit;
  }
  if (criterion_.scores) verdict.score = score(path);
  return verdict;
}

}  // namespace misalign::solver
