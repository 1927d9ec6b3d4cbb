#include "schema/catalogue/sql_tokens.hpp"

#include <algorithm>
#include <string_view>

namespace misalign::schema {
namespace {

// Blanks of SQLite's tokenizer.
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\f' || c == '\r'; }
bool is_of_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == '$';
}

class Tokenizer {
 public:
  explicit Tokenizer(const std::string& sql) : sql_(sql) {}

  SqlTokens all() {
    while (at_ < sql_.size()) {
      if (is_blank(sql_[at_])) {
        ++at_;
      } else if (!skip_comment()) {
        const std::size_t from = at_;
        pass_token();
        tokens_.tokens.push_back(sql_.substr(from, at_ - from));
        tokens_.begins.push_back(from);
      }
    }
    if (sql_.find('\0') != std::string::npos) tokens_.is_open = true;
    return std::move(tokens_);
  }

 private:
  bool starts(std::string_view text) const { return sql_.compare(at_, text.size(), text) == 0; }

  bool skip_comment() {
    if (starts("--")) {
      at_ = std::min(sql_.find('\n', at_), sql_.size());
      tokens_.is_open = at_ == sql_.size();
    } else if (starts("/*")) {
      const std::size_t end = sql_.find("*/", at_ + 2);
      tokens_.is_open = end == std::string::npos;
      at_ = tokens_.is_open ? sql_.size() : end + 2;
    } else {
      return false;
    }
    return true;
  }

  void pass_token() {
    const char first = sql_[at_];
    if ((first == 'x' || first == 'X') && at_ + 1 < sql_.size() && sql_[at_ + 1] == '\'') {
      ++at_;  // a blob, x'00'
      return pass_quoted('\'');
    }
    if (first == '\'' || first == '"' || first == '`') return pass_quoted(first);
    if (first == '[') {
      const std::size_t end = sql_.find(']', at_);
      tokens_.is_open = end == std::string::npos;
      at_ = tokens_.is_open ? sql_.size() : end + 1;
      return;
    }
    if (is_of_word(first)) {
      while (at_ < sql_.size() && is_of_word(sql_[at_])) ++at_;
      return;
    }
    for (const std::string_view sign :
         {"->>", "->", "||", "<=", "<>", "<<", ">=", ">>", "==", "!="}) {
      if (!starts(sign)) continue;
      at_ += sign.size();
      return;
    }
    ++at_;
  }

  // A quotation mark inside is doubled.
  void pass_quoted(char mark) {
    for (++at_; at_ < sql_.size(); ++at_) {
      if (sql_[at_] != mark) continue;
      if (at_ + 1 == sql_.size() || sql_[at_ + 1] != mark) {
        ++at_;
        return;
      }
      ++at_;
    }
    tokens_.is_open = true;
  }

  const std::string& sql_;
  std::size_t at_ = 0;
  SqlTokens tokens_;
};

}  // namespace

SqlTokens sql_tokens(const std::string& sql) { return Tokenizer(sql).all(); }

std::string reason_not_to_enclose(const std::string& sql) {
  const SqlTokens text = sql_tokens(sql + "\n");  // ends a comment of one line
  if (text.is_open) return "it does not close a string, a name or a comment";
  if (text.tokens.empty()) return "it is empty";
  int open = 0;
  for (const std::string& token : text.tokens) {
    if (token == "(") ++open;
    if (token == ")" && --open < 0) return "it closes a bracket that it does not open";
    if (token == ";") return "a semicolon ends it";
    // Names of parameters may hold brackets and quotation marks.
    if (std::string_view("?$@#:").find(token[0]) != std::string_view::npos) {
      return "it has a parameter without a value";
    }
  }
  return open > 0 ? "it does not close a bracket" : "";
}

}  // namespace misalign::schema
