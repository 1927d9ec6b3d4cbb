// Collects the data of a report's page, for a catalogue or a pattern file.
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

/// Options of a page.
struct ReportCall {
  std::string path;    ///< a catalogue or a pattern file
  std::string output;  ///< the page's file, for the commands that it shows
  std::vector<std::uint64_t>
      draws;                   ///< draws with details besides the best; any draws of the campaign
  std::uint64_t rows = 10000;  ///< largest number of candidates in the table
  std::uint64_t details = 36;  ///< number of best candidates with details
  Choice choice;               ///< chosen draws instead; with `where` alone, `details` of them
  std::string beside;          ///< a catalogue whose campaign is compared with this one, or empty
  schema::Design design;       ///< overrides the campaign's
  std::map<std::string_view, bool> studies;  ///< requested studies of the table of studies
  std::vector<std::string> columns;          ///< further functions of sheets in the table
  bool only_remembered = false;  ///< columns are the remembered functions, and compute nothing
  DetailOptions detail;
  int largest_detailed =
      std::numeric_limits<int>::max();  ///< vertices; larger sheets have details only if requested
  std::function<bool()> is_stopped;     ///< asked before each sheet with details
};

/// Returns the data of a catalogue's page, at one moment. UserError: bad_request if the choice is
/// empty, or a splitting search is compared; failure if it is stopped; bad_input as from
/// open_for_reading, or for a stress file of no sheet of this page.
schema::Json report_of_catalogue(const ReportCall& call);

/// Returns the data of a pattern file's page, for its one sheet. UserError (bad_input).
schema::Json report_of_pattern(const ReportCall& call);

}  // namespace misalign::search
