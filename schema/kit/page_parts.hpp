// Writes the common parts of printed pages: their frame, and tables of hinges, springs and plates.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "schema/exchange/length_unit.hpp"
#include "schema/kit/page_style.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::schema {

/// The page up to its heading.
std::string page_begin(const std::string& title, PageStyle style);
inline constexpr const char* kPageEnd = "</main></body></html>\n";

/// The message of a banner, which its sign and its colour repeat.
enum class BannerKind { passes, caution, fails };
/// A banner of a heading and a paragraph.
std::string page_banner(BannerKind kind, const std::string& heading, const std::string& paragraph);

/// A table's row; cells from `numbers` on are aligned to the right.
std::string table_row(const std::vector<std::string>& cells, std::size_t numbers,
                      const char* cell = "td");

/// A table up to its headings, which each of its pages repeats.
std::string table_begin(const std::vector<std::string>& heads, std::size_t numbers,
                        const char* name = "");
inline constexpr const char* kTableEnd = "</tbody></table>\n";

/// Tables side by side of at most 24 rows each, about equally many, none of which a page divides;
/// nothing without rows.
std::string page_tables(const std::vector<std::string>& heads,
                        const std::vector<std::vector<std::string>>& rows, std::size_t numbers);

/// The largest fold angles of hinges in the first `from_row` rows, the gaps and bevels of plates,
/// and the misfit of hinges on faces.
std::string hinge_table(const solver::Sheet& sheet, std::optional<double> thickness_mm,
                        Eigen::Index from_row, double from_deg,
                        LengthUnit unit = LengthUnit::millimetre);

struct SpringLengths {
  double flat_mm, folded_mm;  ///< folded: at the angle of use
};
/// Lengths of a diagonal.
SpringLengths diagonal_lengths(const solver::Sheet& sheet, const solver::Actuation& actuation,
                               int diagonal);

/// One row for each spring, and the largest force, or one row for each hole's rubber plate; nothing
/// for empty holes. `lengths`: between a spring's ends.
std::string filling_table(const solver::Sheet& sheet, const solver::Actuation& actuation,
                          const std::function<SpringLengths(int)>& lengths,
                          LengthUnit unit = LengthUnit::millimetre);

}  // namespace misalign::schema
