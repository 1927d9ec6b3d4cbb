// The common part of the studies of `misalign tolerance`: the request, the sheets, the progress.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/tolerance.hpp"
#include "search/verbs/choice_options.hpp"
#include "solver/play/backlash_follower.hpp"

namespace misalign::search {

struct ToleranceCall {
  std::string path;
  Choice choice;
  ToleranceOptions study;
  std::optional<double> amplitude_mm, backlash_mm;  // or the design's miscut_mm and play_mm
  std::optional<double> from_deg;                   // or the design's
  schema::Design design;                            // typed, over the file's
  solver::BacklashOptions backlash;
  bool keep = true, json = false;
};

/// The candidates that are chosen of a catalogue, or the one sheet of a pattern file.
struct ToleranceTargets {
  schema::Campaign campaign;  // with its own threshold
  schema::Design design;      // the file's, under the typed one
  std::vector<Eigen::Matrix2Xd> shifts_mm;
  std::vector<std::uint64_t> draws;  // one for each sheet; none of a pattern
  std::string pattern;               // its name

  SheetKey key(std::size_t k) const {
    return {draws.empty() ? std::nullopt : std::optional(draws[k]), pattern};
  }
};

/// The chosen candidates of a catalogue. UserError (bad_request, bad_input) with one sentence.
ToleranceTargets choose_sheets(const ToleranceCall& call);
/// The sheet of a pattern file, as a campaign whose threshold is its D. The seed is the default
/// one: an exported candidate does not say its campaign's. UserError (bad_input) where it does not
/// deploy.
ToleranceTargets chosen_sheet(const ToleranceCall& call, const ChosenSheet& chosen);

/// The campaign with the angle of use, if one is given, as the threshold of copies.
/// UserError (bad_request) where that is no sample, or lies beyond D of a sheet.
schema::Campaign campaign_of_use(const ToleranceCall& call, const ToleranceTargets& sheets);

/// Returns whether the answer is one sheet's, named by its draw or file; other choices give a list.
bool is_single(const ToleranceCall& call, const ToleranceTargets& sheets);

/// The study of joint gaps of one overconstrained sheet, whose miscut copies do not fold.
void run_gaps(const ToleranceCall& call, const ToleranceTargets& sheets);

/// The study of backlash: checks of the request (UserError, bad_request) before sheets are chosen,
/// and the study with its answer on standard output.
void check_backlash(const ToleranceCall& call);
void run_backlash(const ToleranceCall& call, const ToleranceTargets& sheets);

}  // namespace misalign::search
