// Reads numbers of CalculiX's results.
#pragma once

#include <cstddef>
#include <string>

namespace misalign::schema {

/// What is larger, or no number at all, is no result: ccx has lost its way there.
inline constexpr double kLargestResult = 1e30;
bool is_result(double value);

/// A number as Fortran writes it: 1.2-103 is 1.2E-103. NaN for a field that holds none, such as
/// stars.
double fortran_number(std::string text);

/// Numbers stand in columns, without a blank between where they are negative.
double fortran_column(const std::string& line, std::size_t begin, std::size_t width);
/// 0, which is no node and no element, where no such number stands.
int fortran_whole(const std::string& line, std::size_t begin, std::size_t width);

}  // namespace misalign::schema
