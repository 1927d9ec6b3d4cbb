// Holds a pattern, or a campaign's, with all that judging its sheets needs, for a Python object.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "search/sheets/chosen_sheet.hpp"

namespace misalign::search::python {

struct PatternSource {
  ChosenSheet sheet;  ///< base, sampling, springs and shifts
  solver::Criterion criterion;
  std::optional<schema::Campaign> campaign;  ///< none for a pattern
  std::vector<int> usual;                    ///< vertices that its sheets usually shift, ascending
  std::string key;                           ///< the same for equal sources
  double safe_mm;  ///< bound of shifts below which every facet stays convex

  const solver::CreasePattern& pattern() const { return sheet.base.base.sheet; }
  int vertices() const { return pattern().vertex_count(); }
};

/// Reads a pattern file, an exported candidate, a FOLD file, or a campaign. UserError (bad_input)
/// as from their readers; (bad_request) for a catalogue.
std::shared_ptr<PatternSource> read_source(const std::string& path);

/// Reads a document like a file with this name; FOLD files are in the working directory.
std::shared_ptr<PatternSource> read_document(const std::string& text, const std::string& name);

/// Returns another sheet of this pattern, with its sampling and design.
std::shared_ptr<PatternSource> with_shifts(const PatternSource& source,
                                           const Eigen::Matrix2Xd& shifts_mm,
                                           const std::string& name);

/// Returns this source judged by the criterion of an object {"by", "fill"}, as in the part "accept"
/// of a campaign, without margins. UserError (bad_input).
std::shared_ptr<PatternSource> judged_by(const PatternSource& source, const std::string& accept);

/// Writes a campaign or a pattern file, which the program can read. UserError (failure).
void write_source(const PatternSource& source, const std::string& path);

/// Returns the source of a catalogue's campaign.
std::shared_ptr<PatternSource> source_of(schema::Campaign campaign);

/// Writes all of a source for pickles, which do not need its file any more.
std::string text_of(const PatternSource& source);
std::shared_ptr<PatternSource> source_of_text(const std::string& text);

}  // namespace misalign::search::python
