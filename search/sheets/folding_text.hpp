// A folding path for people: verdict, each diagonal as a sparkline, and on request its lengths.
#pragma once

#include <string>
#include <vector>

#include "schema/exchange/folding_json.hpp"
#include "schema/pattern/design.hpp"
#include "search/terminal/terminal.hpp"
#include "solver/records/strokes.hpp"

namespace misalign::search {

/// One of eight heights for each value, between the least and the largest; all low if those agree.
std::string sparkline(const std::vector<double>& values, bool utf8);

struct FoldingTextOptions {
  int width = 80;
  bool utf8 = false;
  /// The lengths every 10 degrees and at D, however wide that gets; without it only if they fit.
  bool table = false;
  Paint paint{false};
  double miscut_mm = solver::kLeastStroke_mm;  ///< shorter strokes are mentioned
  std::optional<solver::Fill> fill = {};       ///< filling whose energy is mentioned
};

std::string folding_text(const schema::FoldingView& view, const FoldingTextOptions& options);

/// Returns the filling whose energy `fold` shows: the one that judges the sheet, else the design's.
solver::Fill fill_shown(const schema::Sampling& sampling, const schema::Design& design,
                        const schema::Pattern& pattern);

/// Writes to standard output, as wide as the terminal, with the energy of this filling.
void put_folding(const schema::FoldingView& view, const schema::Design& design,
                 const solver::Fill& fill, bool table);

}  // namespace misalign::search
