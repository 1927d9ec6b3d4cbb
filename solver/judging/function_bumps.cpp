#include "solver/judging/function_bumps.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::solver {
namespace {

// Largest change on a subsegment that is not halved further: far below the band.
constexpr double kShort_widths = 1e-13;
constexpr int kMostHalvings = 40;

}  // namespace

FunctionBumps::FunctionBumps(const Mechanism& mechanism)
    : mechanism_(mechanism),
      flat_(mechanism.diagonals.size()),
      values_(flat_),
      rates_(flat_),
      table_(mechanism.diagonal_count(), PathFunction::kNodes + 1),
      one_way_(mechanism.diagonals.size()),
      kept_(mechanism.diagonals.size()),
      ways_(kept_) {}

FunctionBumps::~FunctionBumps() = default;
FunctionBumps::FunctionBumps(const FunctionBumps&) = default;

void FunctionBumps::begin(const std::vector<double>& flat_lengths) {
  flat_ = flat_lengths;
  take(0);
}

void FunctionBumps::take(double pilot_rad) {
  std::fill(kept_.begin(), kept_.end(), Retreats{});
  reached_rad_ = pilot_rad;
  kept_room_ = 0;
}

void FunctionBumps::begin_segment(const PathFunction& function) {
  in_squares_ = function.from_flat();
  table_.begin();
  for (int k = 0; k < function.kept(); ++k) {
    const PathFunction::Node& node = function.node(k);
    const double x = function.at(k);
    const double per_rate = 1 / (function.variable_rate(k) * (in_squares_ ? 2 * x : 1));
    for (std::size_t d = 0; d < rates_.size(); ++d) rates_[d] = node.slopes[d] * per_rate;
    table_.add(variable(x), node.lengths.data(), rates_.data());
  }
  if (in_squares_) table_.add_value(0, flat_.data());
  table_.finish();
  const double from = function.count() == 2 ? 0 : function.from();
  const Subsegment all = subsegment(variable(from), variable(function.end()));
  double rate[HermiteTable::kMostOrder];
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    table_.find_rate(d, all.from, all.to, rate);
    const auto [least, most] = std::minmax_element(rate, rate + table_.order() - 1);
    one_way_[static_cast<std::size_t>(d)] = *least >= all.largest_error   ? 1
                                            : *most <= -all.largest_error ? -1
                                                                          : 0;
  }
}

double FunctionBumps::look(double x, std::vector<double>& rates) const {
  const double at = variable(x), per_x = in_squares_ ? 2 * x : 1;
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    rates[static_cast<std::size_t>(d)] = table_.rate(d, at) * per_x;
  }
  return subsegment(at, at).largest_error * per_x;
}

std::optional<double> FunctionBumps::rate_there(double x) {
  const double error = look(x, rates_);
  const double rate = rates_[static_cast<std::size_t>(where_)];
  return std::abs(rate) > error ? std::optional(rate) : std::nullopt;
}

FunctionBumps::Heading FunctionBumps::look_at_sample(double x, const Judge& judge,
                                                     const PathFunction& function,
                                                     double least_doubt) {
  go_to(x, true, judge, function);
  return heading(least_doubt);
}

FunctionBumps::Heading FunctionBumps::look_at_end(const Judge& judge, const PathFunction& function,
                                                  double least_doubt) {
  go_to(function.end(), false, judge, function);
  const Heading at_end = heading(least_doubt);
  if (at_end == Heading::unsure) return at_end;
  kept_ = ways_;
  kept_room_ = room_;
  reached_rad_ = function.pilot(function.end());
  return Heading::forward;  // the next sample decides
}

FunctionBumps::Subsegment FunctionBumps::subsegment(double from, double to) const {
  // The oldest node has two terms; flat has a value only.
  const int terms = in_squares_ ? 1 : 2;
  return {from, to, kFunctionSafety * table_.largest_rate_change(from, to, terms)};
}

int FunctionBumps::direction(int diagonal, bool is_sample, const Judge& judge,
                             const PathFunction& function) const {
  if (judge.direction(diagonal) != 0 || is_sample) return judge.direction(diagonal);
  // The newest node shows the direction before a sample does.
  const auto d = static_cast<std::size_t>(diagonal);
  const double moved = function.node(0).lengths[d] - flat_[d];
  return std::abs(moved) < kStepBand_widths ? 0 : moved > 0 ? 1 : -1;
}

void FunctionBumps::go_to(double x, bool is_sample, const Judge& judge,
                          const PathFunction& function) {
  const bool has_gone = kept_room_ > 0;
  ways_ = kept_;
  room_ = kept_room_;
  direction_changed_ = false;
  const double from_x = reached_rad_ == 0 ? 0 : function.locate(reached_rad_);
  if (!(x > from_x)) return;
  room_ = std::max(room_, 2 * function.node_error());
  const Subsegment all = subsegment(variable(from_x), variable(x));
  // Error of the ends if the pilot's angle is a polynomial itself.
  const double off = std::max(function.pilot_error(from_x) / function.pilot_slope(from_x),
                              function.pilot_error(x) / function.pilot_slope(x));
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    Retreats& retreats = ways_[static_cast<std::size_t>(d)];
    const int way = direction(d, is_sample, judge, function);
    direction_changed_ = direction_changed_ || (has_gone && way != 0 && retreats.direction != way);
    retreats.direction = way;
    if (way == 0) retreats = {};
    if (way == 0 || (way == one_way_[static_cast<std::size_t>(d)] && retreats.at_most.now == 0)) {
      continue;
    }
    double rate[HermiteTable::kMostOrder];
    const int count = table_.order() - 1;
    table_.find_rate(d, all.from, all.to, rate);
    for (int k = 0; k < count; ++k) rate[k] *= way;
    const double falls = -std::min(rate[0], rate[count - 1]);
    if (falls > 0) room_ += 2 * off * falls;
    go(all, rate, 0, retreats);
  }
}

// Bounds the retreats on a subsegment: the rate lies between its least and largest coefficients and
// has their mean. The subsegment is halved if the error leaves the direction open.
void FunctionBumps::go(const Subsegment& subsegment, const double* rate, int halvings,
                       Retreats& retreats) const {
  const int count = table_.order() - 1;
  const auto [least, most] = std::minmax_element(rate, rate + count);
  const double width = subsegment.to - subsegment.from, error = subsegment.largest_error;
  double sum = 0;
  for (int k = 0; k < count; ++k) sum += rate[k];
  const double on = sum / count * width;
  const bool is_one_way =
      (*least >= error || *most <= error) && (*least >= -error || *most <= -error);
  if (is_one_way) {
    retreats.at_most.go(on - error * width);
    retreats.at_least.go(on + error * width);
    return;
  }
  if (halvings == kMostHalvings ||
      std::max(std::abs(*least), std::abs(*most)) * width + error * width < kShort_widths) {
    retreats.at_most.go(std::min(*least - error, 0.0) * width);
    retreats.at_least.go(std::max(*most + error, 0.0) * width);
    return;
  }
  // Coefficients of both halves by De Casteljau.
  double left[HermiteTable::kMostOrder], right[HermiteTable::kMostOrder];
  std::copy_n(rate, count, right);
  for (int k = 0; k < count; ++k) {
    left[k] = right[0];
    for (int i = 0; i + 1 < count - k; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
  const double middle = 0.5 * (subsegment.from + subsegment.to);
  go(this->subsegment(subsegment.from, middle), left, halvings + 1, retreats);
  go(this->subsegment(middle, subsegment.to), right, halvings + 1, retreats);
}

FunctionBumps::Heading FunctionBumps::heading(double least_doubt) {
  double doubt = 0, longest_at_least = 0, others_at_most = 0;
  bool is_sure = !direction_changed_;
  where_ = -1;
  for (std::size_t d = 0; d < ways_.size(); ++d) {
    const auto& [at_least, at_most, direction] = ways_[d];
    doubt = std::max(doubt, at_most.longest - at_least.longest);
    if (at_most.longest + room_ < kBumpBand_widths) continue;
    const double least = at_least.longest - room_;
    is_sure = is_sure && least >= kBumpBand_widths;
    if (where_ >= 0 && least <= longest_at_least) continue;
    longest_at_least = least;
    where_ = static_cast<int>(d);
  }
  if (where_ < 0 && is_sure) return Heading::forward;
  for (std::size_t d = 0; d < ways_.size(); ++d) {
    if (static_cast<int>(d) == where_) continue;
    others_at_most = std::max(others_at_most, ways_[d].at_most.longest + room_);
  }
  if (is_sure && longest_at_least > others_at_most) return Heading::back;
  return doubt <= least_doubt ? settle() : Heading::unsure;
}

// Decides by the mean of the bounds of each diagonal's retreat.
FunctionBumps::Heading FunctionBumps::settle() {
  double longest = 0;
  where_ = -1;
  for (std::size_t d = 0; d < ways_.size(); ++d) {
    const double back = 0.5 * (ways_[d].at_least.longest + ways_[d].at_most.longest);
    if (back < kBumpBand_widths || back <= longest) continue;
    longest = back;
    where_ = static_cast<int>(d);
  }
  return where_ < 0 ? Heading::forward : Heading::back;
}

}  // namespace misalign::solver
