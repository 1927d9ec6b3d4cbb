#include "search/sheets/front_query.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "schema/catalogue/costly_terms.hpp"
#include "schema/catalogue/metric_table.hpp"
#include "schema/catalogue/study_table.hpp"
#include "search/sheets/choice.hpp"

namespace misalign::search {
namespace {

// "thickness_mm(draw, 140)" is a thickness_mm.
bool less_is_better(const std::string& word) {
  const std::string name = word.substr(0, word.find('('));
  if (const schema::MetricEntry* const metric = schema::find_metric(name)) {
    return metric->less_is_better;
  }
  const schema::StudyColumn* const column = schema::study_column(name);
  return column && column->less_is_better;
}

}  // namespace

std::string front_sql(SQLite::Database& database, const std::vector<std::string>& words,
                      const std::string& where) {
  std::vector<std::string> columns, known, no_worse, better;
  for (const std::string& word : words) {
    columns.push_back(column_sql(database, word, "front"));
    const bool is_less = less_is_better(schema::in_full(word));
    known.push_back(fmt::format("one.\"{}\" IS NOT NULL", word));
    no_worse.push_back(fmt::format("other.\"{0}\" {1} one.\"{0}\"", word, is_less ? "<=" : ">="));
    better.push_back(fmt::format("other.\"{0}\" {1} one.\"{0}\"", word, is_less ? "<" : ">"));
  }
  const std::string found = best_sql(database, fmt::format("draw, {}", fmt::join(columns, ", ")),
                                     {{}, {}, {}, {}, where});
  // A dominated candidate is dominated by one of the first, so these are tried first.
  const std::string order =
      fmt::format("ORDER BY \"{}\" {}", words.front(),
                  less_is_better(schema::in_full(words.front())) ? "" : "DESC");
  return fmt::format(
      "WITH found AS MATERIALIZED ({}), front AS MATERIALIZED (SELECT * FROM found {}) SELECT * "
      "FROM front AS one WHERE {} AND NOT EXISTS (SELECT 1 FROM front AS other WHERE {} AND ({})) "
      "{}, draw",
      schema::costly_in_subqueries(found), order, fmt::join(known, " AND "),
      fmt::join(no_worse, " AND "), fmt::join(better, " OR "), order);
}

}  // namespace misalign::search
