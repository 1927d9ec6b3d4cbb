// What pages that are printed have in common: their frame, and tables of hinges and springs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/motion/actuation.hpp"

namespace misalign::schema {

/// Up to the heading, with the style of all.
std::string page_begin(const std::string& title);
inline constexpr const char* kPageEnd = "</body></html>\n";

/// A table's row; cells from `numbers` on are to the right.
std::string table_row(const std::vector<std::string>& cells, std::size_t numbers,
                      const char* cell = "td");

/// How far hinges fold in so many rows, what plates need for it, and by how much plates that are
/// hinged on their faces would not meet.
std::string hinge_table(const solver::Sheet& sheet, std::optional<double> thickness_mm,
                        Eigen::Index from_row, double from_deg);

struct SpringLengths {
  double flat_mm, folded_mm;  ///< at the angle of use
};
/// Of a diagonal itself.
SpringLengths diagonal_lengths(const solver::Sheet& sheet, const solver::Actuation& actuation,
                               int diagonal);

/// One row a spring, and the largest force; `lengths` of each from end to end.
std::string spring_table(const solver::Sheet& sheet, const solver::Actuation& actuation,
                         const std::function<SpringLengths(int)>& lengths);

}  // namespace misalign::schema
