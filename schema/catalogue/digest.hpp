// 128-bit fingerprints: of a campaign (identity) and of what a catalogue holds (digest).
#pragma once

#include <xxhash.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// XXH3-128, seed 0.
XXH128_hash_t hash_of(std::string_view bytes);
/// 32 hex digits, the most significant first.
std::string hex(const XXH128_hash_t& hash);

/// Sum modulo 2^128 of XXH3-128(draw as u64, D as u32, little-endian): the same for any order.
class CandidateSum {
 public:
  void add(std::uint64_t draw, int deploys_from_sample);
  void add(const CandidateSum& other);
  /// Little-endian.
  std::array<unsigned char, 16> bytes() const;
  static CandidateSum from_bytes(const unsigned char* bytes);
  friend bool operator==(const CandidateSum&, const CandidateSum&) = default;

 private:
  std::uint64_t low_ = 0, high_ = 0;
};

/// The digest of a catalogue: 32 hex digits. `merged` are disjoint, ascending, none touching the
/// next.
std::string catalogue_digest(const std::string& identity, const std::vector<DrawRange>& merged,
                             std::uint64_t accepted, std::uint64_t undecided,
                             const CandidateSum& candidates);

/// Disjoint ranges in ascending order with touching ones joined, cut off at `end`.
std::vector<DrawRange> merged_up_to(const std::vector<DrawRange>& ascending, std::uint64_t end);

}  // namespace misalign::schema
