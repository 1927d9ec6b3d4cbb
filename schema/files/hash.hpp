// Computes 128-bit hashes of bytes.
#pragma once

#include <xxhash.h>

#include <string>
#include <string_view>

namespace misalign::schema {

/// XXH3-128, seed 0.
XXH128_hash_t hash_of(std::string_view bytes);
/// Returns 32 hex digits, the most significant first.
std::string hex(const XXH128_hash_t& hash);

}  // namespace misalign::schema
