// Reads and writes preloads of single springs: "springs.preloads_n" of a design.
#pragma once

#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/motion/actuators.hpp"

namespace misalign::schema {

/// Reads {"A9-A15": 2}: a spring by the vertices of its diagonal in any order; wrong values are
/// faults. `find_fill_faults` checks that the sheet has such diagonals.
void read_preloads(ObjectReader& reader, std::vector<solver::Preload::OfOne>& preloads);
/// Returns the preloads; null for none.
Json preloads_json(const std::vector<solver::Preload::OfOne>& preloads);

/// Adds "preload_n" and "preloads_n" to an object about springs; nothing if they are relaxed.
void add_preload(const solver::Preload& preload, Json& springs);

/// Returns "3 N", or "up to 3 N" if springs differ.
std::string preload_words(const solver::Preload& preload);

}  // namespace misalign::schema
