// One table of the studies: what each says, whether the report's page may carry it, and its columns
// among the candidates. Whatever lists studies reads it; to add one, see the head of
// study_table.cpp.
#pragma once

#include <span>
#include <string_view>

namespace misalign::schema {

/// A number of a study that ranks sheets: a column of the report's candidates, and the function of
/// SQL that finds it of a draw when it is asked for. Costly: it follows a path.
struct StudyColumn {
  std::string_view name;
  const char* label;  ///< heads the column
  const char* unit;
  const char* meaning;  ///< sentences for people
  bool less_is_better = false;
};

struct StudyEntry {
  std::string_view name;    ///< of its verb
  const char* about;        ///< what it says, in the one line of --help
  const char* in_report{};  ///< help of `report --NAME`; null: there is no such option
  std::span<const StudyColumn> columns{};  ///< which that option adds
};

/// In the order of the report's options.
std::span<const StudyEntry> study_table();
/// One of them.
const StudyEntry& study_named(std::string_view name);
/// The column of whichever study has it; null: none has.
const StudyColumn* study_column(std::string_view name);

}  // namespace misalign::schema
