#include "schema/campaign/share_interval.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <cassert>

namespace misalign::schema {

double share(std::uint64_t hits, std::uint64_t trials) {
  return trials > 0 ? static_cast<double>(hits) / static_cast<double>(trials) : 0;
}

ShareInterval share_interval(std::uint64_t hits, std::uint64_t trials) {
  return share_interval_of(static_cast<double>(hits), static_cast<double>(trials));
}

ShareInterval share_interval_of(double k, double n) {
  if (!(n > 0)) return {0, 1};
  assert(k >= 0 && k <= n);
  using Binomial = boost::math::binomial_distribution<double>;
  constexpr double kOneEnd = 0.05, kEachEnd = kOneEnd / 2;
  if (k == 0) return {0, Binomial::find_upper_bound_on_p(n, k, kOneEnd)};
  if (k == n) return {Binomial::find_lower_bound_on_p(n, k, kOneEnd), 1};
  return {Binomial::find_lower_bound_on_p(n, k, kEachEnd),
          Binomial::find_upper_bound_on_p(n, k, kEachEnd)};
}

ShareInterval share_interval(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials) {
  return {share_interval(hits, trials).low, share_interval(hits + undecided, trials).high};
}

ShareOfTrials share_of(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials) {
  const auto [low, high] = share_interval(hits, undecided, trials);
  const auto decided = static_cast<double>(trials - undecided);
  return {decided > 0 ? static_cast<double>(hits) / decided : 0, low, high};
}

}  // namespace misalign::schema
