#include "schema/files/user_error.hpp"

#include <algorithm>

#include "schema/files/printable.hpp"

namespace misalign::schema {
namespace {

// Marks round a parameter's name: noncharacters of Unicode. In a file's name they could do no more
// than the name "--output" could.
constexpr std::string_view kName = "\uFDD0", kAlone = "\uFDD1", kBeforeValue = "\uFDD2";

constexpr std::size_t kMostOfASentence = 3000;

std::string listed(const std::vector<std::string>& list, std::size_t more) {
  std::string lines;
  const std::size_t shown = std::min(list.size(), kMostListed);
  for (std::size_t k = 0; k < shown; ++k) {
    lines += "\n  " + in_a_sentence(list[k], kMostOfASentence);
  }
  more += list.size() - shown;
  if (more > 0) lines += "\n  and " + std::to_string(more) + " more";
  return lines;
}

std::string named(std::string_view text, NameParameter name_parameter) {
  std::string full;
  for (;;) {
    const std::size_t begin = text.find(kName);
    const std::size_t end = std::min(text.find(kAlone, begin), text.find(kBeforeValue, begin));
    if (end == text.npos) break;
    const std::string_view name = text.substr(begin, end - begin).substr(kName.size());
    full += text.substr(0, begin);
    full += name_parameter(name, text.substr(end).starts_with(kBeforeValue));
    text.remove_prefix(end + kAlone.size());
  }
  full += text;
  for (const std::string_view mark : {kName, kAlone, kBeforeValue}) {  // the others were cut off
    for (std::size_t at; (at = full.find(mark)) != full.npos;) full.erase(at, mark.size());
  }
  return full;
}

std::string name_in_python(std::string_view name, bool has_value) {
  return std::string(name) + (has_value ? "=" : "");
}

std::string sentence_of(const solver::OptionFault& fault) {
  return parameter(fault.name, fault.value) + ": " + fault.why + "; " + fault.suggestion;
}

}  // namespace

std::string parameter(std::string_view name, const std::optional<std::string>& value) {
  std::string marked(kName);
  return marked.append(name).append(value ? kBeforeValue : kAlone).append(value.value_or(""));
}

UserError::UserError(Cause cause, const std::string& sentence)
    : UserError(cause, sentence, {}, 0) {}

UserError::UserError(Cause cause, const std::string& sentence, const std::vector<std::string>& list,
                     std::size_t more)
    : std::runtime_error(
          named(in_a_sentence(sentence, kMostOfASentence) + listed(list, more), name_in_python)),
      cause_(cause),
      marked_(in_a_sentence(sentence, kMostOfASentence) + listed(list, more)) {}

UserError::UserError(const solver::OptionFault& fault)
    : UserError(Cause::bad_request, sentence_of(fault)) {}

std::string UserError::sentence(NameParameter name_parameter) const {
  return named(marked_, name_parameter);
}

std::string in_a_sentence(const std::string& text, std::size_t most) {
  // Shortens before and after escaping: a value can be as long as its file.
  return shortened(printable(shortened(text, most)), most);
}

}  // namespace misalign::schema
