// Reads and writes pattern files, and reads exported candidates.
#pragma once

#include <filesystem>
#include <string>

#include "schema/pattern/design.hpp"
#include "schema/pattern/pattern_json.hpp"
#include "schema/pattern/sampling.hpp"
#include "schema/pattern/target.hpp"

namespace misalign::schema {

/// Returns whether a document is a campaign: it has a "pattern" and no keys of an export.
bool is_campaign(const Json& document);

struct PatternFile {
  Pattern pattern;
  Sampling sampling;                            ///< an exported candidate has its campaign's
  Design design;                                ///< "design" beside the pattern; empty without one
  std::optional<Target> target = std::nullopt;  ///< "target" beside the pattern
  Json exported;  ///< its results (candidate.schema.json); null for other patterns
};

/// Reads a pattern file; an exported candidate, JSON or FOLD; or a FOLD mesh without shifts.
/// UserError (3) with every fault.
PatternFile read_sampled_pattern_file(const std::string& path,
                                      Perforations perforations = Perforations::of_one_freedom);

/// Reads the document of such a file; sentences name `source`. A FOLD file that it names is
/// relative to `directory`.
PatternFile read_sampled_pattern(const Json& document, const std::string& source,
                                 const std::filesystem::path& directory,
                                 Perforations perforations = Perforations::of_one_freedom);

/// Writes a pattern as such a file, with sampling and design where they differ from defaults, and
/// its target. Samples end where the sheet can be judged.
Json pattern_file_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm, Sampling sampling,
                       const Design& design, const std::optional<Target>& target = {});

/// Reads the pattern of such a file.
Pattern read_pattern_file(const std::string& path,
                          Perforations perforations = Perforations::of_one_freedom);

}  // namespace misalign::schema
