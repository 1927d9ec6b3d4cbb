#include "schema/catalogue/digest.hpp"

namespace misalign::schema {
namespace {

template <class Integer>
void append_little_endian(std::string& bytes, Integer value) {
  for (std::size_t k = 0; k < sizeof value; ++k) {
    bytes.push_back(static_cast<char>(static_cast<unsigned char>(value >> (8 * k))));
  }
}

}  // namespace

void CandidateSum::add(std::uint64_t draw, int deploys_from_sample, const std::string& sheet) {
  std::string bytes;
  append_little_endian(bytes, draw);
  append_little_endian(bytes, static_cast<std::uint32_t>(deploys_from_sample));
  add_text(bytes + sheet);
}

void CandidateSum::add_text(const std::string& text) {
  const XXH128_hash_t hash = hash_of(text);
  CandidateSum term;
  term.low_ = hash.low64;
  term.high_ = hash.high64;
  add(term);
}

void CandidateSum::add(const CandidateSum& other) {
  low_ += other.low_;
  high_ += other.high_ + (low_ < other.low_ ? 1 : 0);
}

void CandidateSum::subtract(const CandidateSum& other) {
  high_ -= other.high_ + (low_ < other.low_ ? 1 : 0);
  low_ -= other.low_;
}

std::array<unsigned char, 16> CandidateSum::bytes() const {
  std::array<unsigned char, 16> bytes{};
  for (int k = 0; k < 8; ++k) {
    bytes[k] = static_cast<unsigned char>(low_ >> (8 * k));
    bytes[8 + k] = static_cast<unsigned char>(high_ >> (8 * k));
  }
  return bytes;
}

CandidateSum CandidateSum::from_bytes(const unsigned char* bytes) {
  CandidateSum sum;
  for (int k = 0; k < 8; ++k) {
    sum.low_ |= static_cast<std::uint64_t>(bytes[k]) << (8 * k);
    sum.high_ |= static_cast<std::uint64_t>(bytes[8 + k]) << (8 * k);
  }
  return sum;
}

std::string catalogue_digest(const std::string& identity, const std::vector<DrawRange>& merged,
                             std::uint64_t accepted, std::uint64_t undecided,
                             const CandidateSum& candidates) {
  std::string bytes = identity;
  for (const DrawRange& range : merged) {
    append_little_endian(bytes, range.lo);
    append_little_endian(bytes, range.hi);
  }
  append_little_endian(bytes, accepted);
  append_little_endian(bytes, undecided);
  for (const unsigned char byte : candidates.bytes()) bytes.push_back(static_cast<char>(byte));
  return hex(hash_of(bytes));
}

}  // namespace misalign::schema
