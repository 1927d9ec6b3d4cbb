#include "search/sheets/known_numbers.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace misalign::search {
namespace {

// Numbers of this time are lost where the program is killed.
constexpr double kBetweenTransactions_s = 1;

}  // namespace

void KnownNumbers::add(const StudyCall& call, const Eigen::Matrix2Xd& shifts_mm,
                       const StudyNumbers& computed) {
  for (std::size_t k = 0; k < kNumberCount; ++k) {
    if (!computed.is_found[k]) continue;
    const std::optional<double>& number = set(k, call, computed.numbers[k]);
    if (!has_memory_) continue;
    unkept_.push_back(described(k, call, shifts_mm));
    unkept_.back().value = number;
  }
  if (since_kept_.seconds() > kBetweenTransactions_s) remember();
}

schema::StudyNumber KnownNumbers::described(std::size_t function, const StudyCall& call,
                                            const Eigen::Matrix2Xd& shifts_mm) {
  return {std::string(sheet_number_names()[function]),
          call.from_deg,
          call.draw,
          schema::sheet_key(shifts_mm),
          {}};
}

const std::optional<double>& KnownNumbers::set(std::size_t function, const StudyCall& call,
                                               std::optional<double> number) {
  StudyNumbers& numbers = numbers_[call];
  numbers.is_found[function] = true;
  return numbers.numbers[function] = number;
}

void KnownNumbers::remember() {
  memory_.keep(unkept_);
  unkept_.clear();
  since_kept_ = Stopwatch();
  warn_once();
}

void KnownNumbers::warn_once() {
  if (!memory_.fault().empty() && !std::exchange(has_warned_, true)) spdlog::warn(memory_.fault());
}

}  // namespace misalign::search
