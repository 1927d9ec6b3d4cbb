// `misalign report`: one page about a catalogue.
#pragma once

#include <string>
#include <vector>

#include "search/folded_draw.hpp"

namespace misalign::search {

struct ReportOptions {
  std::string catalogue_path, output;
  std::vector<std::uint64_t> draws;  ///< to look at, beside the best; any draws of the campaign
  std::uint64_t rows = 10000;        ///< at most so many candidates in the table
  std::uint64_t details = 36;        ///< so many of the best ones can be looked at
  OtherActuators actuators;
};

void write_report(const ReportOptions& options);

}  // namespace misalign::search
