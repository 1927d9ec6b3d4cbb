#include "schema/pattern/spring_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "schema/files/json_values.hpp"
#include "schema/files/suggestion.hpp"
#include "schema/files/text_lines.hpp"
#include "schema/files/text_table.hpp"
#include "schema/pattern/csv_text.hpp"

namespace misalign::schema {
namespace {

using solver::SpringAction;
using solver::StockSpring;

constexpr std::size_t kMostRows = 2000;

constexpr const char* kActions[] = {"pulls", "pushes"};

enum class Need { always, by_pulling, by_pushing, never };

// A column of numbers; the longest and the shortest length are both the limit of use.
struct NumberColumn {
  const char* name;
  double StockSpring::*number;
  double least, most;
  Need need;
  const char* suggestion;
};
constexpr NumberColumn kNumbers[] = {
    {"rate_n_per_mm", &StockSpring::rate_n_per_mm, 1e-6, 1e6, Need::always, "write its rate"},
    {"free_mm", &StockSpring::free_mm, 1e-3, 1e6, Need::always,
     "write its length without force, from hook to hook"},
    {"longest_mm", &StockSpring::limit_mm, 1e-3, 1e6, Need::by_pulling,
     "write the largest length to which it may be pulled"},
    {"shortest_mm", &StockSpring::limit_mm, 1e-3, 1e6, Need::by_pushing,
     "write the shortest length to which it may be pressed"},
    {"wire_mm", &StockSpring::wire_mm, 1e-3, 1e4, Need::always, "write its wire's diameter"},
    {"outer_mm", &StockSpring::outer_mm, 1e-3, 1e4, Need::always, "write its coils' diameter"},
    {"price", &StockSpring::price, 0, 1e9, Need::always, "write the price of one, in any currency"},
    {"initial_n", &StockSpring::initial_n, 0, 1e6, Need::never,
     "write the force that begins to lengthen it, or nothing"}};

// Returns whether springs of an action have a column.
bool has_column(SpringAction action, const NumberColumn& column) {
  const bool pulls = action == SpringAction::pulls;
  return column.need != (pulls ? Need::by_pushing : Need::by_pulling) &&
         (pulls || column.number != &StockSpring::initial_n);
}

// Columns that a table must have.
bool is_required(const NumberColumn& column) { return column.need == Need::always; }

std::vector<std::string> column_names() {
  std::vector<std::string> names = {"name", "kind"};
  for (const NumberColumn& column : kNumbers) names.emplace_back(column.name);
  return names;
}

class TableReader {
 public:
  TableReader(const std::string& text, const std::string& source)
      : lines_(csv_lines(text)), source_(source) {}

  std::vector<SpringRow> read() {
    if (lines_.empty()) {
      faults_.add("the table", "is empty", "write a line of column names, then a line a spring");
    } else {
      read_header(lines_.front());
    }
    faults_.refuse(source_);
    for (std::size_t k = 1; k < lines_.size(); ++k) read_row(lines_[k]);
    if (rows_.empty() && faults_.none()) {
      faults_.add("the table", "has no springs", "write a line a spring below the column names");
    }
    if (rows_.size() > kMostRows) {
      faults_.add("the table", fmt::format("has {} springs", rows_.size()),
                  fmt::format("keep at most {}", kMostRows));
    }
    faults_.refuse(source_);
    return std::move(rows_);
  }

 private:
  void read_header(const CsvLine& header) {
    const std::vector<std::string> known = column_names();
    for (std::size_t k = 0; k < header.cells.size(); ++k) {
      const std::string& name = header.cells[k];
      const std::string where = fmt::format("line {}: {}", header.number, name);
      if (std::ranges::find(known, name) == known.end()) {
        faults_.add(where, "is no column of springs" + meant_names(name, known),
                    fmt::format("the columns are {}", fmt::join(known, ", ")));
      } else if (!columns_.emplace(name, k).second) {
        faults_.add(where, "occurs twice", "take one out");
      }
    }
    const auto require = [&](const std::string& name) {
      if (columns_.contains(name) || !faults_.none()) return;
      faults_.add(fmt::format("line {}: {}", header.number, name), "is missing",
                  "add that column; commas divide columns");
    };
    require("name");
    for (const NumberColumn& column : kNumbers) {
      if (is_required(column)) require(column.name);
    }
    if (!columns_.contains("longest_mm") && !columns_.contains("shortest_mm")) {
      require("longest_mm");
    }
  }

  std::string cell(const CsvLine& line, const std::string& column) const {
    const auto at = columns_.find(column);
    return at == columns_.end() || at->second >= line.cells.size() ? "" : line.cells[at->second];
  }

  void refuse(const CsvLine& line, const std::string& column, const std::string& why,
              const std::string& suggestion) {
    const std::string text = cell(line, column);
    faults_.add(fmt::format("line {}: {}{}", line.number, column, text.empty() ? "" : " = " + text),
                why, suggestion);
  }

  void read_number(const CsvLine& line, const NumberColumn& column, SpringAction action,
                   StockSpring& spring) {
    const std::string text = cell(line, column.name);
    const bool is_of_other = !has_column(action, column);
    if (is_of_other && !text.empty()) {
      return refuse(line, column.name, fmt::format("is not of a spring that {}", word_of(action)),
                    "leave the cell empty");
    }
    if (is_of_other || (text.empty() && column.need == Need::never)) return;
    const std::optional<double> number = number_of<double>(text);
    if (!number || !std::isfinite(*number)) {
      return refuse(line, column.name, text.empty() ? "is missing" : "is no number",
                    column.suggestion);
    }
    if (*number < column.least || *number > column.most) {
      return refuse(line, column.name,
                    fmt::format("must be from {} to {}", shown_number(column.least),
                                shown_number(column.most)),
                    column.suggestion);
    }
    spring.*column.number = *number + 0.0;
  }

  // Lengths and diameters that contradict each other.
  void check_sizes(const CsvLine& line, const StockSpring& spring) {
    if (spring.action == SpringAction::pulls && spring.limit_mm <= spring.free_mm) {
      refuse(line, "longest_mm", "must be more than free_mm", "write both lengths in mm");
    }
    if (spring.action == SpringAction::pushes && spring.limit_mm >= spring.free_mm) {
      refuse(line, "shortest_mm", "must be less than free_mm", "write both lengths in mm");
    }
    if (2 * spring.wire_mm >= spring.outer_mm) {
      refuse(line, "wire_mm", "must be less than half of outer_mm", "write both diameters in mm");
    }
  }

  void read_row(const CsvLine& line) {
    const std::size_t before = faults_.count();
    if (line.cells.size() > lines_.front().cells.size()) {
      faults_.add(fmt::format("line {}", line.number), "has more cells than there are columns",
                  "divide columns by commas, and write decimals with a point");
      return;
    }
    SpringRow row{cell(line, "name"), {}};
    if (row.name.empty()) refuse(line, "name", "is missing", "write a name to order it by");
    if (!row.name.empty() && !names_.emplace(row.name, line.number).second) {
      refuse(line, "name", fmt::format("is the name of line {}, too", names_.at(row.name)),
             "give each spring a name of its own");
    }
    const std::string kind = cell(line, "kind");
    const auto* const action = std::ranges::find(kActions, kind);
    if (kind.empty() || action != std::end(kActions)) {
      if (kind == kActions[1]) row.spring.action = SpringAction::pushes;
    } else {
      return refuse(line, "kind", "is no kind of springs", "write pulls, pushes or nothing");
    }
    for (const NumberColumn& column : kNumbers) {
      read_number(line, column, row.spring.action, row.spring);
    }
    if (faults_.count() == before) check_sizes(line, row.spring);
    if (faults_.count() == before) rows_.push_back(std::move(row));
  }

  const std::vector<CsvLine> lines_;
  const std::string& source_;
  std::map<std::string, std::size_t> columns_, names_;
  std::vector<SpringRow> rows_;
  InputFaults faults_;
};

}  // namespace

const char* word_of(SpringAction action) { return kActions[action == SpringAction::pushes]; }

std::vector<SpringRow> spring_table_of(const std::string& text, const std::string& source) {
  return TableReader(text, source).read();
}

std::vector<SpringRow> read_spring_table(const std::string& path) {
  return spring_table_of(read_input_file(path), path);
}

Json spring_row_json(const SpringRow& row) {
  Json json = {{"name", utf8(row.name)}, {"kind", word_of(row.spring.action)}};
  for (const NumberColumn& column : kNumbers) {
    const bool is_its = has_column(row.spring.action, column);
    json[column.name] = is_its ? Json(row.spring.*column.number) : Json();
  }
  return json;
}

std::vector<StockSpring> springs_of(const std::vector<SpringRow>& table) {
  std::vector<StockSpring> springs;
  for (const SpringRow& row : table) springs.push_back(row.spring);
  return springs;
}

}  // namespace misalign::schema
