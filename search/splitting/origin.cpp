#include "search/splitting/origin.hpp"

namespace misalign::search {

std::uint64_t number_of(const Origin& origin, const schema::Splitting& splitting) {
  std::uint64_t number = origin.population * schema::kNumbersOfPopulation + origin.particle;
  if (origin.level == 0) return number;
  const std::uint64_t steps =
      (origin.level - std::uint64_t{1}) * splitting.sweeps + (origin.step - 1);
  return number + splitting.first_draws + steps * splitting.particles;
}

Origin origin_of(std::uint64_t number, const schema::Splitting& splitting) {
  const auto narrow = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
  Origin origin{narrow(number / schema::kNumbersOfPopulation), 0, 0, 0};
  std::uint64_t rest = number % schema::kNumbersOfPopulation;
  if (rest < splitting.first_draws) {
    origin.particle = narrow(rest);
    return origin;
  }
  rest -= splitting.first_draws;
  origin.particle = narrow(rest % splitting.particles);
  rest /= splitting.particles;
  origin.step = narrow(rest % splitting.sweeps + 1);
  origin.level = narrow(rest / splitting.sweeps + 1);
  return origin;
}

}  // namespace misalign::search
