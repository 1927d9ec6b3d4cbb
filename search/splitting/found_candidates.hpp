// Collects the different sheets that a population has met, each where it was met first.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>
#include <vector>

#include "schema/records/unit_record.hpp"
#include "search/splitting/piece.hpp"

namespace misalign::search {

/// The place at which a sheet was met.
struct Origin {
  std::uint32_t population, level, step, particle;
  friend auto operator<=>(const Origin&, const Origin&) = default;
};

struct FoundCandidate {
  Origin origin;
  schema::Candidate candidate;
};

inline constexpr std::uint64_t kAllSheets = std::numeric_limits<std::uint64_t>::max();

/// Keeps a fingerprint of every sheet, and the candidates of the `most` smallest origins. The
/// result does not depend on the order in which they are added.
class FoundCandidates {
 public:
  explicit FoundCandidates(std::uint64_t most) : most_(most) {}

  void add(const Origin& origin, schema::Candidate candidate);
  /// Counts the different sheets that were first met at each level.
  void count(std::vector<schema::LevelCount>& levels) const;
  /// Returns the kept candidates by their origins, and removes them.
  std::vector<FoundCandidate> take();

 private:
  /// A 128-bit hash of a sheet's shifts; hash tables use the lower half.
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
