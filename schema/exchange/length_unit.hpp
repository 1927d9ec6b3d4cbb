// Units of length of drawings and printed pages.
#pragma once

#include <fmt/format.h>

#include <string>

namespace misalign::schema {

enum class LengthUnit { millimetre, inch };

inline constexpr double kInch_mm = 25.4;

inline const char* name_of(LengthUnit unit) { return unit == LengthUnit::inch ? "in" : "mm"; }

/// A length in mm as a number of units.
inline double in_unit(double length_mm, LengthUnit unit) {
  return unit == LengthUnit::inch ? length_mm / kInch_mm : length_mm;
}

/// A length as a number, with this number of decimals for millimetres; inches have one more.
inline std::string length_number(double length_mm, LengthUnit unit, int decimals) {
  return fmt::format("{:.{}f}", in_unit(length_mm, unit),
                     unit == LengthUnit::inch ? decimals + 1 : decimals);
}

/// The same with its unit.
inline std::string length_text(double length_mm, LengthUnit unit, int decimals) {
  return length_number(length_mm, unit, decimals) + " " + name_of(unit);
}

}  // namespace misalign::schema
