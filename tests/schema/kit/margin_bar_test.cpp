// Bars of a card's margins: zero, the value and the limit lie in proportion, the side that meets
// the requirement holds its value exactly where it passes, and what is left has its unit and its
// word.
#include "schema/kit/margin_bar.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace misalign::schema {
namespace {

using Bound = CardLine::Bound;

CardLine line_with(double wanted, std::optional<double> found, Bound bound,
                   const std::string& unit = "") {
  return {"key", "Quantity", unit, wanted, found, bound, ""};
}

// Ends of a rectangle, in percent.
std::pair<double, double> ends_of(const std::string& svg, const std::string& name) {
  const std::regex shape("class=\"" + name +
                         "\" x=\"([-.0-9]+)%\"(?: y=\"25%\")? width=\"([-.0-9]+)%\"");
  std::smatch found;
  EXPECT_TRUE(std::regex_search(svg, found, shape)) << svg;
  return {std::stod(found[1]), std::stod(found[1]) + std::stod(found[2])};
}

double limit_of(const std::string& svg) {
  const std::regex shape("x1=\"([-.0-9]+)%\" x2=\"([-.0-9]+)%\"");
  std::smatch found;
  EXPECT_TRUE(std::regex_search(svg, found, shape)) << svg;
  EXPECT_EQ(found[1], found[2]);
  return std::stod(found[1]);
}

TEST(MarginBar, PlacesNumbersInProportion) {
  constexpr double kPercent = 0.011;  // of two decimals
  for (const double wanted : {-3.0, 0.0, 1e-6, 1.0, 140.0, 1e6}) {
    for (const double found : {-2.0, 0.0, 1e-6, 0.9999, 1.0, 139.0, 3e7}) {
      for (const Bound bound : {Bound::at_least, Bound::at_most}) {
        const CardLine line = line_with(wanted, found, bound);
        const std::string svg = margin_bar(line);
        const auto [from, to] = ends_of(svg, "value");
        const auto [least, most] = ends_of(svg, "met");
        const double limit = limit_of(svg), zero = found < 0 ? to : from,
                     tip = found < 0 ? from : to;
        for (const double end : {from, to, least, most, limit}) {
          EXPECT_GE(end, 0);
          EXPECT_LE(end, 100 + kPercent);
        }
        EXPECT_NEAR((tip - zero) * wanted, (limit - zero) * found,
                    kPercent * (std::abs(wanted) + std::abs(found)))
            << svg;
        // The tip lies on the green side exactly where the line passes, unless both are at one
        // place.
        if (std::abs(tip - limit) > kPercent) {
          EXPECT_EQ(tip > least - kPercent && tip < most + kPercent, line.passes()) << svg;
        }
      }
    }
  }
}

TEST(MarginBar, SaysWhatIsLeft) {
  EXPECT_EQ(left_text(line_with(140, 156, Bound::at_least, "deg")), "16° left");
  EXPECT_EQ(left_text(line_with(20, 1.2, Bound::at_most, "N")), "18.8 N left");
  EXPECT_EQ(left_text(line_with(1, 0.25, Bound::at_least)), "0.75 short");
  EXPECT_EQ(left_text(line_with(0, 4, Bound::at_most)), "4 over");
  EXPECT_EQ(left_text(line_with(0, 0, Bound::at_most)), "none left");
  EXPECT_EQ(left_text(line_with(0.3, 0.1 + 0.2, Bound::at_least)), "none left");
  EXPECT_EQ(left_text(line_with(0.1 + 0.2, 0.3, Bound::at_least)), "just missed");
  EXPECT_EQ(left_text(line_with(1, {}, Bound::at_least)), "no result");
  EXPECT_EQ(margin_bar(line_with(1, {}, Bound::at_least)), "");
  EXPECT_EQ(margin_bar(line_with(1, INFINITY, Bound::at_least)), "");
  EXPECT_EQ(left_text(line_with(1, INFINITY, Bound::at_least)), "");
}

}  // namespace
}  // namespace misalign::schema
