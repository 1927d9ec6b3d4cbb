// Computes the numbers of the table of studies of one sheet.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "search/sheets/folding_model.hpp"

namespace misalign::search {

/// One for each column of the table of studies.
inline constexpr std::size_t kNumberCount = 17;
using WantedNumbers = std::array<bool, kNumberCount>;
const std::array<std::string_view, kNumberCount>& sheet_number_names();
/// Returns whether the number needs SUNDIALS.
bool needs_sundials(std::size_t number);

struct StudyNumbers {
  WantedNumbers is_found{};
  std::array<std::optional<double>, kNumberCount> numbers;  ///< none also where a study has none
};

/// The wanted numbers of a sheet of this design, used from `from_deg`, or from the design's angle,
/// or from each number's default. `is_candidate` spares finding D where it is known. Those of a
/// shape need a target.
StudyNumbers find_numbers(const solver::Sheet& sheet, const schema::Design& design,
                          std::optional<double> from_deg, const WantedNumbers& wanted,
                          bool is_candidate, const schema::Target* target = nullptr);

}  // namespace misalign::search
