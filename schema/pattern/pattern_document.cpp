#include "schema/pattern/pattern_document.hpp"

#include <algorithm>
#include <cctype>

#include "schema/pattern/obj_format.hpp"

namespace misalign::schema {
namespace {

bool is_named_obj(const std::string& path) {
  constexpr std::string_view kEnding = ".obj";
  return path.size() >= kEnding.size() &&
         std::ranges::equal(std::string_view(path).substr(path.size() - kEnding.size()), kEnding,
                            [](unsigned char a, char b) { return std::tolower(a) == b; });
}

}  // namespace

Json read_pattern_document(const std::string& path, FileKind kind) {
  const std::string text = read_input_file(path, kind);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view body = text;
  if (body.starts_with(kByteOrderMark)) body.remove_prefix(kByteOrderMark.size());
  if (is_named_obj(path) || is_obj(body)) return obj_as_fold(body);
  const std::size_t first = body.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || body[first] == '{' || body[first] == '[') {
    return parse_json(text, path);
  }
  const std::string begin(
      body.substr(first, std::min(body.find('\n', first) - first, body.size())));
  throw UserError(
      Cause::bad_input,
      path + ": is not JSON, FOLD or OBJ (it begins with \"" +
          printable(shortened(utf8(begin), 40)) +
          "\"); give a pattern in JSON, or a flat mesh of quadrilaterals in FOLD or OBJ");
}

}  // namespace misalign::schema
