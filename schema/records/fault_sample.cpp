#include "schema/records/fault_sample.hpp"

namespace misalign::schema {

std::uint64_t FaultSampleRule::rows_below(std::uint64_t end) const {
  constexpr int kDense = 27, kRowsOfADoubling_log2 = 16;
  const auto multiples = [](std::uint64_t draws, int k) {  // rounded up, without overflow
    return (draws >> k) + ((draws & ((std::uint64_t{1} << k) - 1)) != 0);
  };
  const int m = static_cast<int>(std::bit_width(end)) - 1;  // 2^m <= end < 2^(m + 1)
  if (!gets_rarer_ || m < kDense) return multiples(end, 10);
  const std::uint64_t doublings = (std::uint64_t{1} << (kDense - 10)) +
                                  (static_cast<std::uint64_t>(m - kDense) << kRowsOfADoubling_log2);
  return doublings + multiples(end - (std::uint64_t{1} << m), m - kRowsOfADoubling_log2);
}

}  // namespace misalign::schema
