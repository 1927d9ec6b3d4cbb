#include "schema/catalogue/costly_terms.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

#include "schema/catalogue/sql_tokens.hpp"
#include "schema/catalogue/study_table.hpp"

namespace misalign::schema {
namespace {

SqlTokens lower_tokens(const std::string& sql) {
  SqlTokens text = sql_tokens(sql);
  for (std::string& token : text.tokens) {
    for (char& c : token) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

bool is_costly(const std::string& token) { return study_column(token); }

// Returns the cost of a function of a sheet, larger for costlier ones; 0 for other tokens.
int cost_of(const std::string& token) {
  const StudyColumn* const column = study_column(token);
  return column ? 1 + static_cast<int>(column->cost) : 0;
}

// Tell whether a token begins or ends a condition.
bool begins_condition(const std::string& token) { return token == "where" || token == "on"; }
bool ends_condition(const std::string& token) {
  static const std::set<std::string_view> kWords = {"select", "from",   "join",     "group",
                                                    "having", "order",  "limit",    "window",
                                                    "union",  "except", "intersect"};
  return kWords.contains(token);
}

std::string in_subqueries(const std::string& sql, bool is_condition) {
  struct Bracket {
    bool in_condition, of_costly;
  };
  const SqlTokens text = lower_tokens(sql);
  std::vector<Bracket> open = {{is_condition, false}};
  std::string made;
  std::size_t copied = 0;
  const auto insert = [&](std::size_t at, const char* more) {
    made += sql.substr(copied, at - copied) + more;
    copied = at;
  };
  for (std::size_t k = 0; k < text.tokens.size(); ++k) {
    const std::string& token = text.tokens[k];
    if (token == "(") {
      const bool of_costly = open.back().in_condition && k > 0 && is_costly(text.tokens[k - 1]);
      if (of_costly) insert(text.begins[k - 1], "(SELECT ");
      open.push_back({open.back().in_condition, of_costly});
    } else if (token == ")" && open.size() > 1) {
      if (open.back().of_costly) insert(text.begins[k] + 1, ")");
      open.pop_back();
    } else if (begins_condition(token)) {
      open.back().in_condition = k > 0 && text.tokens[k - 1] != "(";  // that is FILTER (WHERE
    } else if (ends_condition(token)) {
      open.back().in_condition = false;
    }
  }
  return made + sql.substr(copied);
}

struct Term {
  std::string text;
  int cost = 0;
};

// Returns the terms that AND joins outside of all brackets; the whole condition if OR joins any.
std::vector<Term> terms_of(const std::string& condition) {
  const SqlTokens text = lower_tokens(condition);
  std::vector<Term> terms;
  std::vector<std::string> open;  // brackets, CASE, and BETWEEN, whose AND joins no terms
  std::size_t first = 0;
  int cost = 0;
  const auto end_term = [&](std::size_t end) {
    if (end == first) return;
    const std::size_t begin = text.begins[first];
    const std::size_t stop = text.begins[end - 1] + text.tokens[end - 1].size();
    terms.push_back({condition.substr(begin, stop - begin), cost});
    first = end + 1;
    cost = 0;
  };
  for (std::size_t k = 0; k < text.tokens.size(); ++k) {
    const std::string& token = text.tokens[k];
    const std::string closes = open.empty() ? "" : open.back();
    cost = std::max(cost, cost_of(token));
    if (token == "(" || token == "case" || token == "between") {
      open.push_back(token == "(" ? ")" : token == "case" ? "end" : "and");
    } else if (token == closes) {
      open.pop_back();
    } else if (open.empty() && token == "or") {
      return {{condition, 1}};
    } else if (open.empty() && token == "and") {
      end_term(k);
    }
  }
  end_term(text.tokens.size());
  return terms;
}

}  // namespace

std::string costly_in_subqueries(const std::string& query) { return in_subqueries(query, false); }

bool calls_costly(const std::string& sql) {
  const SqlTokens text = lower_tokens(sql);
  return std::ranges::any_of(text.tokens, is_costly);
}

bool has_limit(const std::string& sql) {
  const SqlTokens text = lower_tokens(sql);
  return std::ranges::find(text.tokens, "limit") != text.tokens.end();
}

std::string in_full(const std::string& sql) {
  const SqlTokens typed = sql_tokens(sql), lower = lower_tokens(sql);
  std::string made;
  std::size_t copied = 0;
  for (std::size_t k = 0; k < typed.tokens.size(); ++k) {
    const std::string before = k > 0 ? lower.tokens[k - 1] : "";
    const std::string after = k + 1 < typed.tokens.size() ? typed.tokens[k + 1] : "";
    if (before == "." || before == "as" || after == "(" || after == ".") continue;
    const std::string& token = typed.tokens[k];
    const std::string meant = token == "D"                    ? "deploys_from_deg"
                              : study_column(lower.tokens[k]) ? lower.tokens[k] + "(draw)"
                                                              : "";
    if (meant.empty()) continue;
    made += sql.substr(copied, typed.begins[k] - copied) + meant;
    copied = typed.begins[k] + token.size();
  }
  return made + sql.substr(copied);
}

std::string costly_last(const std::string& condition) {
  std::vector<Term> terms = terms_of(condition);
  std::ranges::stable_sort(terms, {}, &Term::cost);
  std::string ordered;
  for (const Term& term : terms) ordered += (ordered.empty() ? "" : " AND ") + term.text;
  return in_subqueries(ordered, true);
}

}  // namespace misalign::schema
