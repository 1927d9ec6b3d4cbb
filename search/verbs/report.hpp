// `misalign report`: one page about a catalogue, or a pattern.
#pragma once

#include <string>
#include <vector>

#include "search/checks/folded_sheet.hpp"
#include "search/verbs/choice.hpp"

namespace misalign::search {

/// A draw to look at makes some 0.1 MB of the page, on a large sheet 0.4 MB.
inline constexpr std::uint64_t kMostDetails = 1000;

struct ReportOptions {
  std::string path;  ///< a catalogue or a pattern file
  std::string output;
  std::vector<std::uint64_t> draws;  ///< to look at, beside the best; any draws of the campaign
  std::uint64_t rows = 10000;        ///< at most so many candidates in the table
  std::uint64_t details = 36;        ///< so many of the best ones can be looked at
  Choice choice;                     ///< whom to look at instead; of `where` alone, `details` many
  OtherActuators actuators;
};

void write_report(const ReportOptions& options);
/// The same of a pattern file: one sheet, no campaign and nothing to choose.
void write_report_of_pattern(const ReportOptions& options);

}  // namespace misalign::search
