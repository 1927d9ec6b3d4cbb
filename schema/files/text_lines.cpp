#include "schema/files/text_lines.hpp"

namespace misalign::schema {

Words words_of(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r\f\v";
  line = line.substr(0, line.find('#'));
  Words words;
  for (std::size_t begin = line.find_first_not_of(kBlank); begin < line.size();) {
    const std::size_t end = std::min(line.find_first_of(kBlank, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlank, end);
  }
  return words;
}

}  // namespace misalign::schema
