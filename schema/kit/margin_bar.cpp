#include "schema/kit/margin_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/exchange/xml_text.hpp"

namespace misalign::schema {
namespace {

// Room beyond the farthest number, and the difference that rounding makes, over the range.
constexpr double kBeyond = 0.1, kRounding = 1e-9;

bool has_numbers(const CardLine& line) {
  return line.wanted && line.found && std::isfinite(*line.wanted) && std::isfinite(*line.found);
}

std::string rectangle(const char* name, double from, double to,
                      const char* down = "height=\"100%\"") {
  return fmt::format("<rect class=\"{}\" x=\"{:.2f}%\" width=\"{:.2f}%\" {}/>", name,
                     std::min(from, to), std::abs(to - from), down);
}

}  // namespace

std::string left_text(const CardLine& line) {
  if (!has_numbers(line)) return line.found ? "" : "no result";
  const bool is_least = line.bound == CardLine::Bound::at_least;
  const double left = is_least ? *line.found - *line.wanted : *line.wanted - *line.found;
  if (std::abs(left) <= kRounding * std::max(std::abs(*line.found), std::abs(*line.wanted))) {
    return line.passes() ? "none left" : "just missed";
  }
  const std::string unit = line.unit == "deg" ? "°" : line.unit.empty() ? "" : " " + line.unit;
  return fmt::format("{:.3g}{} {}", std::abs(left), unit,
                     left > 0   ? "left"
                     : is_least ? "short"
                                : "over");
}

std::string margin_bar(const CardLine& line) {
  if (!has_numbers(line)) return "";
  const auto [least, most] = std::minmax({0.0, *line.wanted, *line.found});
  const double range = most > least ? most - least : 1,
               first = least < 0 ? least - kBeyond * range : 0, last = most + kBeyond * range;
  const auto at = [&](double value) { return 100 * (value - first) / (last - first); };
  const double limit = at(*line.wanted);
  return fmt::format(
      "<svg class=\"bar\" role=\"img\" aria-label=\"{}\">{}{}{}"
      "<line class=\"limit\" x1=\"{:.2f}%\" x2=\"{:.2f}%\" y1=\"-20%\" y2=\"120%\"/></svg>",
      xml_text(fmt::format("actual {}, required {}: {}", line.found_text(), line.wanted_text(),
                           left_text(line))),
      rectangle("range", 0, 100),
      line.bound == CardLine::Bound::at_least ? rectangle("met", limit, 100)
                                              : rectangle("met", 0, limit),
      rectangle("value", at(0), at(*line.found), "y=\"25%\" height=\"50%\""), limit, limit);
}

}  // namespace misalign::schema
