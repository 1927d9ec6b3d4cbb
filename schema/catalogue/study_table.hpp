// One table of the studies: what each says, whether the report's page may carry it, and its columns
// among the candidates. Whatever lists studies reads it; to add one, see the head of
// study_table.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace misalign::schema {

/// What a number costs of one sheet: conditions ask for the dearer ones later.
enum class Cost {
  path,    ///< its path is followed: some ms
  motion,  ///< it is let go, too
  contact  ///< panels are walked along the path: about a tenth of a second
};

/// A number of a study that ranks sheets: the function of SQL NAME(draw) or NAME(draw, from_deg)
/// that finds it when it is asked for (search/sheets/study_functions.cpp says how), in conditions
/// also NAME alone; and a column of the report's candidates.
struct StudyColumn {
  std::string_view name;
  const char* label;  ///< heads the column
  const char* unit;
  const char* meaning;  ///< sentences for people
  Cost cost;
  bool less_is_better = false;
  bool in_report = false;  ///< whether `report --STUDY` adds it; --column adds any
};

struct StudyEntry {
  std::string_view name;    ///< of its verb
  const char* about;        ///< what it says, in the one line of --help
  const char* in_report{};  ///< help of `report --NAME`; null: there is no such option
  std::span<const StudyColumn> columns{};

  /// Whether that option adds some of them.
  bool has_columns_in_report() const;
};

/// In the order of the report's options.
std::span<const StudyEntry> study_table();
/// One of them.
const StudyEntry& study_named(std::string_view name);
/// The column of whichever study has it; null: none has.
const StudyColumn* study_column(std::string_view name);
/// All names, in the table's order.
std::vector<std::string> study_functions();

}  // namespace misalign::schema
