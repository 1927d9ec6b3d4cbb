// The sheets that a population has met, each where it was met first.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>
#include <vector>

#include "schema/records/unit_record.hpp"
#include "search/splitting/piece.hpp"

namespace misalign::search {

/// Where a sheet was met.
struct Origin {
  std::uint32_t population, level, step, particle;
  friend auto operator<=>(const Origin&, const Origin&) = default;
};

struct FoundCandidate {
  Origin origin;
  schema::Candidate candidate;
};

inline constexpr std::uint64_t kAllSheets = std::numeric_limits<std::uint64_t>::max();

/// Of all sheets only a fingerprint is kept; of those with the least origins, so many at most, what
/// is known of them. What comes of it does not depend on the order in which they are added.
class FoundCandidates {
 public:
  explicit FoundCandidates(std::uint64_t most) : most_(most) {}

  void add(const Origin& origin, schema::Candidate candidate);
  /// How many different ones were met at each level for the first time.
  void count(std::vector<schema::LevelCount>& levels) const;
  /// Those that were kept, by their origins; none are left.
  std::vector<FoundCandidate> take();

 private:
  /// 128 bits of a sheet's shifts, of which a table of them takes the lower half.
  struct Print {
    std::uint64_t low, high;
    friend bool operator==(const Print&, const Print&) = default;
  };
  struct LowHalf {
    std::size_t operator()(const Print& print) const { return print.low; }
  };
  static Print print_of(const schema::Candidate& candidate);

  std::uint64_t most_;
  std::unordered_map<Print, Origin, LowHalf> first_;
  std::map<Origin, schema::Candidate> kept_;
};

}  // namespace misalign::search
