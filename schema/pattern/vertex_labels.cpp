#include "schema/pattern/vertex_labels.hpp"

#include <charconv>

namespace misalign::schema {

int vertex_of_label(const std::string& label, int vertex_count) {
  int number = 0;
  const char* const end = label.data() + label.size();
  if (label.size() < 2 || label[0] != 'A' || label[1] == '0') return -1;
  const auto [stop, error] = std::from_chars(label.data() + 1, end, number);
  if (error != std::errc{} || stop != end || number < 1 || number > vertex_count) return -1;
  return number - 1;
}

}  // namespace misalign::schema
