// A pattern, or a campaign's, with everything that is asked of its sheets: what a Python object
// holds.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "search/sheets/chosen_sheet.hpp"

namespace misalign::search::python {

struct PatternSource {
  ChosenSheet sheet;  ///< base, sampling, springs; its own shifts
  solver::Criterion criterion;
  std::optional<schema::Campaign> campaign;  ///< none for a pattern
  std::vector<int> usual;  ///< vertices that its sheets are expected to shift, ascending
  std::string key;         ///< the same for equal sources
  double safe_mm;          ///< below it no facet loses its convexity, whatever is shifted

  const solver::CreasePattern& pattern() const { return sheet.base.base.sheet; }
  int vertices() const { return pattern().vertex_count(); }
};

/// A pattern file, an exported candidate, a FOLD file, or a campaign. UserError (bad_input) as
/// those readers; (bad_request) for a catalogue.
std::shared_ptr<PatternSource> read_source(const std::string& path);

/// What a document says, as a file would, named `name`; FOLD files lie in the working directory.
std::shared_ptr<PatternSource> read_document(const std::string& text, const std::string& name);

/// Another sheet of this pattern, with its sampling and design.
std::shared_ptr<PatternSource> with_shifts(const PatternSource& source,
                                           const Eigen::Matrix2Xd& shifts_mm,
                                           const std::string& name);

/// Writes what the program reads again: a campaign or a pattern file. UserError (failure).
void write_source(const PatternSource& source, const std::string& path);

/// A catalogue's campaign.
std::shared_ptr<PatternSource> source_of(schema::Campaign campaign);

/// All of a source, for pickles: whatever file it was read from need not be there any more.
std::string text_of(const PatternSource& source);
std::shared_ptr<PatternSource> source_of_text(const std::string& text);

}  // namespace misalign::search::python
