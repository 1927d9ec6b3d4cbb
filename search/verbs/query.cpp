// `misalign query`: a named query, or any read-only SQL.
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "schema/catalogue/query_text.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/catalogue/study_table.hpp"
#include "search/terminal/nothing_found.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct QueryCall {
  std::string path, sql = "best", where;
  std::optional<std::string> front;
  bool json = false, csv = false, unpaged = false;
};

// Explains, instead of a header without rows, why a named query of candidates found none. False if
// there is nothing to say.
bool show_nothing_found(SQLite::Database& database, const std::string& sql) {
  if (sql.find("FROM candidate") == std::string::npos) return false;
  const std::vector<std::string> sentences = nothing_found(database, schema::read_state(database));
  for (const std::string& sentence : sentences) put(schema::printable(sentence) + "\n");
  std::fflush(stdout);
  return !sentences.empty();
}

void show_rows(SQLite::Database& database, const std::string& name, const std::string& sql,
               bool paged) {
  std::optional<Show> out;  // none before the first row
  std::optional<std::string> header;
  const auto show_header = [&] {
    out.emplace(paged);
    return out->write(paint_for(STDOUT_FILENO).bold(*header) + "\n");
  };
  const std::uint64_t rows =
      schema::write_query(database, sql, schema::TableStyle::aligned, [&](const std::string& line) {
        if (header) return (out || show_header()) && out->write(line);
        header = line.substr(0, line.size() - 1);
        return true;
      });
  if (!out) {
    if (!name.empty() && show_nothing_found(database, sql)) return;
    show_header();
  }
  out.reset();
  std::fflush(stdout);
  if (!name.empty() && schema::leaves_rows_out(database, sql, rows)) {
    spdlog::info(
        "the first {} rows; SQL of your own can ask for more, such as \"SELECT * FROM candidates\"",
        rows);
  }
}

// Splits "D, thickness_mm(draw, 140)" at commas outside brackets.
std::vector<std::string> listed(const std::string& typed) {
  std::vector<std::string> words(1);
  int depth = 0;
  for (const char c : typed) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0) {
      words.emplace_back();
    } else if (c != ' ' || !words.back().empty()) {
      words.back() += c;
    }
  }
  return words;
}

void query(const QueryCall& call, const Parts& parts) {
  const auto database = schema::open_for_reading(call.path);
  need_part(!call.front || parts.front_sql, "finds no front");
  if (parts.add_study_functions) parts.add_study_functions(*database, call.path);
  const schema::QueryText text =
      call.front
          ? schema::QueryText{parts.front_sql(*database, listed(*call.front), call.where), ""}
          : schema::query_text(*database, call.sql);
  if (parts.look_ahead) parts.look_ahead(*database, text.sql);
  if (!call.json && !call.csv) {
    show_rows(*database, text.name, text.sql, !call.unpaged);
    return;
  }
  const auto style = call.json ? schema::TableStyle::json : schema::TableStyle::csv;
  schema::write_query(*database, text.sql, style, [&](const std::string& part) {
    call.json ? put_json(part) : put_csv(part);
    return std::ferror(stdout) == 0;
  });
}

// A line for each function of sheets.
std::string functions_text() {
  std::string text;
  for (const std::string& name : schema::study_functions()) {
    text += fmt::format("  {:30} {}\n", name, schema::study_column(name)->unit);
  }
  return text;
}

}  // namespace

Action query_verb(CLI::App& verb, const Parts& parts) {
  verb.description("a named query, or any read-only SQL");
  verb.footer(
      "Named queries: " + schema::named_query_list() +
      ".\nFunctions of any draw, found on demand with the campaign's design, as NAME(draw),\n"
      "NAME(draw, from_deg) from another angle of use, or NAME alone:\n" +
      functions_text() +
      "D is deploys_from_deg. Every --where and --by takes the same words.\nElongations and "
      "strokes are shares of a length: stroke_max < 0.08 is 8 %.\n"
      "On a terminal the rows go through $PAGER [less].\n\n"
      "Examples:\n  misalign query results/miura-6x6-1a2b3c4d.db best\n"
      "  misalign query results/miura-6x6-1a2b3c4d.db --front miscut_margin_mm,stroke_max\n"
      "  misalign query results/miura-6x6-1a2b3c4d.db --csv \\\n"
      "    \"SELECT draw FROM candidates WHERE stroke_max < 0.08\"");
  auto call = std::make_shared<QueryCall>();
  verb.add_option("CATALOGUE", call->path, "catalogue file")->required();
  auto* const sql = verb.add_option("QUERY", call->sql, "name or SQL [best]");
  auto* const front =
      verb.add_option("--front", call->front,
                      "the Pareto front of these columns or functions, such as "
                      "end_value,miscut_margin_mm: candidates that no other dominates")
          ->excludes(sql)
          ->type_name("NAME,NAME");
  verb.add_option("--where", call->where, "the front of the candidates that satisfy this condition")
      ->needs(front)
      ->type_name("SQL");
  auto* json_flag = verb.add_flag("--json", call->json, "as JSON; a second column x is called x_2");
  verb.add_flag("--csv", call->csv, "as CSV; on a terminal control characters are escaped")
      ->excludes(json_flag);
  add_jobs(verb);
  verb.add_flag("--no-pager", call->unpaged, "print without a pager");
  return [call, parts] {
    query(*call, parts);
    return 0;
  };
}

}  // namespace misalign::search
