// Files of patterns as people write them, and exported candidates.
#pragma once

#include <filesystem>
#include <string>

#include "schema/pattern/design.hpp"
#include "schema/pattern/pattern_json.hpp"
#include "schema/pattern/sampling.hpp"

namespace misalign::schema {

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

}  // namespace misalign::schema
