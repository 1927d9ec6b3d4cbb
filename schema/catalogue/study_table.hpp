// Tables the studies: help texts, options of the report, and columns of the candidates. All code
// that lists studies reads it; study_table.cpp says how to add one.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace misalign::schema {

/// Cost of a number per sheet; conditions evaluate costly ones last.
enum class Cost {
  path,    ///< follows the path: some ms
  motion,  ///< computes the deployment, too
  contact  ///< walks the panels along the path: about a tenth of a second
};

/// A number of a study that ranks sheets: SQL's function NAME(draw) or NAME(draw, from_deg), which
/// computes it on request (search/sheets/study_functions.cpp), in conditions also NAME alone; and a
/// column of the report's candidates.
struct StudyColumn {
  std::string_view name;
  const char* label;  ///< heading of the column
  const char* unit;
  const char* meaning;  ///< sentences for people
  Cost cost;
  bool less_is_better = false;
  bool in_report = false;  ///< true if `report --STUDY` adds it; --column adds any
  bool usual = false;      ///< an axis of the report, as MetricEntry::usual
  int version = 1;         ///< raised with another computation: no older number is used then
};

struct StudyEntry {
  std::string_view name;    ///< name of its verb
  const char* about;        ///< one line of --help
  const char* in_report{};  ///< help of `report --NAME`; null without such an option
  std::span<const StudyColumn> columns{};

  /// Returns whether that option adds columns.
  bool has_columns_in_report() const;
};

/// Returns all studies, in the order of the report's options.
std::span<const StudyEntry> study_table();
/// Returns the study of this name, which must exist.
const StudyEntry& study_named(std::string_view name);
/// Returns the column of this name; null if no study has it.
const StudyColumn* study_column(std::string_view name);
/// Returns all names of columns, in the table's order.
std::vector<std::string> study_functions();

}  // namespace misalign::schema
