// `misalign export`: chosen candidates, or a pattern, as files.
#pragma once

#include "search/checks/folded_sheet.hpp"
#include "search/verbs/choice.hpp"

namespace misalign::search {

enum class ExportFormat { json, csv, fold, svg, obj };

struct ExportOptions {
  std::string path;  ///< a catalogue or a pattern file
  Choice choice;
  ExportFormat format = ExportFormat::json;
  double step_deg = 10;  ///< between two states of `fold` and `obj`
  bool creases = false;  ///< with `csv`: also the table of fold angles
  OtherActuators actuators;
  std::string output;  ///< directory
};

/// Writes each candidate's files, or for `csv` the one table of all of them, whole or not at all,
/// and prints their names: of the campaign and the draw, or of a table of several the campaign.
void export_candidates(const ExportOptions& options);
/// The same of a pattern file; there is nothing to choose.
void export_pattern(const ExportOptions& options);

}  // namespace misalign::search
