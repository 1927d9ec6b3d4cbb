#include "schema/catalogue/candidate_words.hpp"

#include <string_view>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/files/suggestion.hpp"

namespace misalign::schema {

std::vector<std::string> columns_of_candidates(SQLite::Database& database) {
  return reading(database, [&] {
    const SQLite::Statement candidates(database, "SELECT * FROM candidates LIMIT 0");
    std::vector<std::string> columns;
    for (int k = 0; k < candidates.getColumnCount(); ++k) {
      columns.emplace_back(candidates.getColumnName(k));
    }
    return columns;
  });
}

std::vector<std::string> words_of_candidates(const std::vector<std::string>& columns) {
  std::vector<std::string> words = columns;
  for (const std::string& name : study_functions()) words.push_back(name);
  return words;
}

// D is the manual's symbol for deploys_from_deg.
std::string column_meant(const std::string& typed, const std::vector<std::string>& columns) {
  const bool is_d = typed == "D" || typed == "d";
  const std::string meant =
      is_d ? "deploys_from_deg" : nearest_word(typed, words_of_candidates(columns));
  return meant.empty() ? "" : "; did you mean " + meant + "?";
}

UnknownWord unknown_word_of(const std::string& refused) {
  for (const auto& [kind, message] :
       {std::pair{"column", "no such column: "}, {"function", "no such function: "}}) {
    const std::size_t before = refused.find(message);
    if (before == std::string::npos) continue;
    const std::size_t begin = before + std::string_view(message).size(),
                      end = refused.find(')', begin);
    return {kind, refused.substr(begin, end - begin)};
  }
  return {nullptr, ""};
}

}  // namespace misalign::schema
