// The data of a report's page: of a catalogue, or of a pattern file.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "search/report/report_details.hpp"
#include "search/sheets/choice.hpp"

namespace misalign::search {

/// What a page is asked for.
struct ReportCall {
  std::string path;                  ///< a catalogue or a pattern file
  std::string output;                ///< where the page is written, for the commands that it shows
  std::vector<std::uint64_t> draws;  ///< to look at, beside the best; any draws of the campaign
  std::uint64_t rows = 10000;        ///< at most so many candidates in the table
  std::uint64_t details = 36;        ///< so many of the best ones can be looked at
  Choice choice;                     ///< whom to look at instead; of `where` alone, `details` many
  schema::Design design;             ///< goes before the campaign's
  std::map<std::string_view, bool> studies;  ///< of the table of studies, those that were asked for
  std::vector<std::string> columns;          ///< functions of sheets that the table has besides
  DetailOptions detail;
  int largest_detailed = std::numeric_limits<int>::max();  ///< vertices; larger sheets if asked for
  std::function<bool()> is_stopped;  ///< asked before each sheet that is looked at closely
};

/// What the page of a catalogue shows, all that the catalogue says of one moment. UserError:
/// bad_request a choice of nothing; failure it is stopped; bad_input as from open_for_reading, or a
/// stress file of no sheet of this page.
schema::Json report_of_catalogue(const ReportCall& call);

/// The same of a pattern file's one sheet. UserError (bad_input).
schema::Json report_of_pattern(const ReportCall& call);

}  // namespace misalign::search
