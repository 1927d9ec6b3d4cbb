// Reads numbers from CalculiX's results.
#pragma once

#include <cstddef>
#include <string>

namespace misalign::schema {

/// Larger values and NaN are no results: ccx has diverged.
inline constexpr double kLargestResult = 1e30;
bool is_result(double value);

/// A number in Fortran's format: 1.2-103 is 1.2E-103. NaN for a field without one, such as stars.
double fortran_number(std::string text);

/// The number in a column; columns of negative numbers have no blank between them.
double fortran_column(const std::string& line, std::size_t begin, std::size_t width);
/// The whole number in a column; 0, which is no node or element, where there is none.
int fortran_whole(const std::string& line, std::size_t begin, std::size_t width);

}  // namespace misalign::schema
