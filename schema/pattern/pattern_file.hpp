// Patterns as people write them, and exported candidates.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "schema/files/input.hpp"
#include "schema/pattern/design.hpp"
#include "schema/pattern/pattern.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "schema/pattern/sampling.hpp"

namespace misalign::schema {

enum class Displacements { allowed, refused };

/// Reads and checks a pattern object at `where`. Only when it added no fault is the result usable.
/// A FOLD file that it names is looked for in `directory`; what a catalogue or an exported
/// candidate holds comes without one, and may name none: its mesh is with it.
Pattern read_pattern(const Json& value, const std::string& where, Displacements displacements,
                     const std::optional<std::filesystem::path>& directory, InputFaults& faults,
                     Perforations perforations = Perforations::of_one_freedom);

/// Whether a document is a campaign: its "pattern" stands beside nothing that an export says.
bool is_campaign(const Json& document);

struct PatternFile {
  Pattern pattern;
  Sampling sampling;  ///< an exported candidate's is its campaign's
  Design design;      ///< "design" beside the pattern; nothing where there is none
  Json exported;  ///< what an export says of it (candidate.schema.json); null for other patterns
};

/// A pattern file; an exported candidate, JSON or FOLD; or a FOLD mesh without shifts. UserError
/// (3) with every fault.
PatternFile read_sampled_pattern_file(const std::string& path,
                                      Perforations perforations = Perforations::of_one_freedom);

/// The same of what it holds; sentences name `source`. A FOLD file that it names is looked for in
/// `directory`.
PatternFile read_sampled_pattern(const Json& document, const std::string& source,
                                 const std::filesystem::path& directory,
                                 Perforations perforations = Perforations::of_one_freedom);

/// A pattern as such a file, with what of sampling and design is no default.
Json pattern_file_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm,
                       const Sampling& sampling, const Design& design);

/// The pattern of such a file.
Pattern read_pattern_file(const std::string& path,
                          Perforations perforations = Perforations::of_one_freedom);

/// The base with these shifts, in the contract's names; displacements only where there are some.
/// Reading it again gives the same pattern.
Json pattern_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm);

/// {"A10": [0.4, 0.0], ...}: the vertices that are shifted, exactly.
Json displacements_json(const Eigen::Matrix2Xd& shifts_mm);

/// [row, column] of a facet.
Json facet_json(const Pattern& pattern, int facet);
/// The facet there; -1 if the sheet has none.
int facet_of_json(const Pattern& pattern, const Json& place);

}  // namespace misalign::schema
