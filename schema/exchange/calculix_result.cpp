#include "schema/exchange/calculix_result.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

namespace misalign::schema {

double fortran_number(std::string text) {
  const std::size_t sign = text.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && text[sign - 1] >= '0' && text[sign - 1] <= '9') {
    text.insert(sign, "E");
  }
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_whole = end != text.c_str() &&
                        std::string_view(end).find_first_not_of(" \r") == std::string_view::npos;
  return is_whole ? value : std::nan("");
}

bool is_result(double value) { return std::abs(value) <= kLargestResult; }

double fortran_column(const std::string& line, std::size_t begin, std::size_t width) {
  if (line.size() < begin + width) return std::nan("");
  return fortran_number(line.substr(begin, width));
}

int fortran_whole(const std::string& line, std::size_t begin, std::size_t width) {
  const double value = fortran_column(line, begin, width);
  return value > 0 && value <= std::numeric_limits<int>::max() ? static_cast<int>(value) : 0;
}

}  // namespace misalign::schema
