// Computes the digest of a catalogue's results.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "schema/campaign/draw_range.hpp"
#include "schema/files/hash.hpp"

namespace misalign::schema {

/// Sum modulo 2^128 of XXH3-128(draw as u64, D as u32, little-endian; of a splitting search then
/// the sheet's own hash), independent of the order.
class CandidateSum {
 public:
  void add(std::uint64_t draw, int deploys_from_sample, const std::string& sheet = {});
  void add(const CandidateSum& other);
  void subtract(const CandidateSum& other);
  /// Adds XXH3-128 of a text, the history of a population.
  void add_text(const std::string& text);
  /// Returns the sum, little-endian.
  std::array<unsigned char, 16> bytes() const;
  static CandidateSum from_bytes(const unsigned char* bytes);
  friend bool operator==(const CandidateSum&, const CandidateSum&) = default;

 private:
  std::uint64_t low_ = 0, high_ = 0;
};

/// Returns the digest of a catalogue: 32 hex digits. `merged` as from united.
std::string catalogue_digest(const std::string& identity, const std::vector<DrawRange>& merged,
                             std::uint64_t accepted, std::uint64_t undecided,
                             const CandidateSum& candidates);

}  // namespace misalign::schema
