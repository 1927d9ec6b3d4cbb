// The common part of the studies of `misalign tolerance`: what was asked, of which sheets, and the
// progress.
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
  solver::BacklashOptions backlash;
  std::optional<int> jobs;
  bool keep = true, json = false;
};

/// The candidates that are chosen of a catalogue, or the one sheet of a pattern file.
struct ToleranceTargets {
  schema::Campaign campaign;  // with its own threshold
  schema::Design design;      // the file's
  std::vector<Eigen::Matrix2Xd> shifts_mm;
  std::vector<std::uint64_t> draws;  // one for each sheet; none of a pattern
  std::string pattern;               // its name

  SheetKey key(std::size_t k) const {
    return {draws.empty() ? std::nullopt : std::optional(draws[k]), pattern};
  }
};

/// Those of a catalogue that are asked about. UserError (bad_request, bad_input) with one sentence.
ToleranceTargets choose_sheets(const ToleranceCall& call);
/// A pattern file's as a campaign of its own, from whose threshold the sheet itself just deploys.
/// The seed is the default one: an exported candidate does not say its campaign's. UserError
/// (bad_input) where it deploys from nothing.
ToleranceTargets chosen_sheet(const ToleranceCall& call, const ChosenSheet& chosen);

/// The same campaign, from whose threshold copies are to deploy: the angle of use if one is said.
/// UserError (bad_request) where that is no sample, or lies beyond D of a sheet.
schema::Campaign campaign_of_use(const ToleranceCall& call, const ToleranceTargets& sheets);

/// Whether one that was named is an answer of its own; what a choice finds is a list.
bool is_single(const ToleranceCall& call, const ToleranceTargets& sheets);

/// Says how many are judged.
void show_copies(const CopiesDone& copies);

/// The study of gaps, of an overconstrained sheet, whose miscut copies do not fold.
/// One at a time.
void run_gaps(const ToleranceCall& call, const ToleranceTargets& sheets);

/// The study of backlash: UserError (bad_request) for what no study can be made of, found before
/// the sheets are and after, and the study with its answer on standard output.
void check_backlash(const ToleranceCall& call);
void run_backlash(const ToleranceCall& call, const ToleranceTargets& sheets);

}  // namespace misalign::search
