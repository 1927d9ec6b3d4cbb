#include "schema/kit/stroke_font.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace misalign::schema {
namespace {

constexpr double kCapital = 6, kWide = 4, kApart = 1.2;  // sizes in steps of the letters' grid

// Strokes by points of that grid, x and y, from the base line's left end.
std::string_view strokes_of(char letter) {
  switch (letter) {
    case '0':
      return "10 01 05 16 36 45 41 30 10";
    case '1':
      return "04 26 20";
    case '2':
      return "05 16 36 45 44 00 40";
    case '3':
      return "06 46 24 34 43 41 30 10 01";
    case '4':
      return "30 36 02 42";
    case '5':
      return "46 06 04 34 43 41 30 10 01";
    case '6':
      return "45 36 16 05 01 10 30 41 42 33 03";
    case '7':
      return "06 46 10";
    case '8':
      return "13 04 05 16 36 45 44 33 13 02 01 10 30 41 42 33";
    case '9':
      return "01 10 30 41 45 36 16 05 04 13 43";
    case 'A':
      return "00 04 26 44 40/02 42";
    case 'b':
      return "06 00 30 41 43 34 04";
    case 'c':
      return "43 34 14 03 01 10 30 41";
    case 'r':
      return "00 03 14 34";
    case 's':
      return "43 34 14 03 12 32 41 30 10 01";
    default:
      throw std::logic_error(fmt::format("the font has no '{}'", letter));
  }
}

}  // namespace

std::vector<DrawnPath> strokes_of(const DrawnText& text) {
  const double step_mm = text.height_mm / kCapital,
               width = static_cast<double>(text.words.size()) * (kWide + kApart) - kApart;
  double left = -0.5 * width;
  std::vector<DrawnPath> paths;
  for (const char letter : text.words) {
    paths.push_back({{}, false});
    const std::string_view strokes = strokes_of(letter);
    for (std::size_t k = 0; k < strokes.size(); k += 3) {
      if (k > 0 && strokes[k - 1] == '/') paths.push_back({{}, false});
      const Eigen::Vector2d at(left + (strokes[k] - '0'), strokes[k + 1] - '0');
      paths.back().points_mm.emplace_back(text.at_mm + step_mm * at);
    }
    left += kWide + kApart;
  }
  return paths;
}

}  // namespace misalign::schema
