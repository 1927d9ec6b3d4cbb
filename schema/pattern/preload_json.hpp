// What is left in springs at flat, where each has its own: "springs.preloads_n" of a design.
#pragma once

#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/motion/actuators.hpp"

namespace misalign::schema {

/// {"A9-A15": 2}: which spring, by the vertices of its diagonal in any order; what is wrong is a
/// fault. Whether the sheet has such diagonals says `check_preloads`.
void read_preloads(ObjectReader& reader, std::vector<solver::Preload::OfOne>& preloads);
/// Null for none.
Json preloads_json(const std::vector<solver::Preload::OfOne>& preloads);

/// Adds one for each that names no diagonal of the sheet, or one that another names, too.
void find_preload_faults(const std::vector<solver::Preload::OfOne>& preloads,
                         const solver::Mechanism& mechanism, InputFaults& faults);
/// UserError where there is one.
void check_preloads(const std::vector<solver::Preload::OfOne>& preloads,
                    const solver::Mechanism& mechanism);

/// "preload_n" of an object about springs, and "preloads_n"; nothing where they are relaxed.
void add_preload(const solver::Preload& preload, Json& springs);

/// "3 N", or "up to 3 N" where springs differ.
std::string preload_words(const solver::Preload& preload);

}  // namespace misalign::schema
