#include "schema/pattern/csv_text.hpp"

#include <algorithm>
#include <string_view>

namespace misalign::schema {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t\r";

std::string trimmed(const std::string& cell) {
  const std::size_t begin = cell.find_first_not_of(kBlanks);
  if (begin == std::string::npos) return "";
  return cell.substr(begin, cell.find_last_not_of(kBlanks) - begin + 1);
}

class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : text_(text) {}

  CsvLine next_line() {
    CsvLine line{number_, {}};
    while (next_cell(line)) {
    }
    return line;
  }
  bool is_done() const { return at_ >= text_.size(); }
  bool is_comment() const { return text_[at_] == '#'; }
  void skip_line() {
    while (!is_done() && text_[at_] != '\n') ++at_;
    ++at_, ++number_;
  }

 private:
  // Adds a cell; returns false where it is the last of its line.
  bool next_cell(CsvLine& line) {
    std::string cell;
    bool is_quoted = false;
    for (; !is_done() && text_[at_] != ',' && text_[at_] != '\n'; ++at_) {
      if (text_[at_] == '"' && trimmed(cell).empty() && !is_quoted) {
        is_quoted = true;
        cell = quotation();
      } else if (!is_quoted || kBlanks.find(text_[at_]) == std::string_view::npos) {
        cell += text_[at_];
      }
    }
    line.cells.push_back(is_quoted ? cell : trimmed(cell));
    const bool goes_on = !is_done() && text_[at_] == ',';
    if (!goes_on) ++number_;
    ++at_;
    return goes_on;
  }

  // The text between quotation marks, of which the last is at `at_` then.
  std::string quotation() {
    std::string text;
    for (++at_; !is_done(); ++at_) {
      if (text_[at_] == '\n') ++number_;
      if (text_[at_] == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') return text;
        ++at_;
      }
      text += text_[at_];
    }
    --at_;
    return text;
  }

  std::string_view text_;
  std::size_t at_ = 0, number_ = 1;
};

}  // namespace

std::vector<CsvLine> csv_lines(const std::string& text) {
  std::string_view view = text;
  if (view.starts_with(kByteOrderMark)) view.remove_prefix(kByteOrderMark.size());
  CsvReader reader(view);
  std::vector<CsvLine> lines;
  while (!reader.is_done()) {
    if (reader.is_comment()) {
      reader.skip_line();
      continue;
    }
    CsvLine line = reader.next_line();
    if (std::ranges::any_of(line.cells, [](const auto& cell) { return !cell.empty(); })) {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

}  // namespace misalign::schema
