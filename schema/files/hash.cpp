#include "schema/files/hash.hpp"

#include "schema/files/hexadecimal.hpp"

namespace misalign::schema {

XXH128_hash_t hash_of(std::string_view bytes) { return XXH3_128bits(bytes.data(), bytes.size()); }

std::string hex(const XXH128_hash_t& hash) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash);
  return hex(bytes.digest);
}

}  // namespace misalign::schema
