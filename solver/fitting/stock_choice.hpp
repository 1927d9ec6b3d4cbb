// Chooses springs of a table for the diagonals of one sheet, each with a link of its own length, so
// that the sheet's energy falls from the angle of use to flat against the friction of its creases.
#pragma once

#include <vector>

#include "solver/fill/fill.hpp"
#include "solver/fitting/stock_options.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

/// A spring on a diagonal, which never leaves the range in which it is linear.
struct StockedSpring {
  int diagonal, type;  ///< type: index in the table
  double link_mm;
  double least_mm, most_mm;  ///< lengths of the diagonal from flat to the angle of use
  double largest_force_n;    ///< largest size of the force
  double linear_free_mm;     ///< free length of the linear spring that spring and link are
  double flat_n;             ///< force on the flat sheet, positive where it pulls
  int side;                  ///< 1: the diagonal lengthens as the sheet folds, -1: it shortens
};

struct StockChoice {
  StockOptions options;
  double from_deg;
  std::vector<StockedSpring> springs;  ///< ascending diagonals; none where no choice drives
  double price = 0;
  double static_n_mm_per_mm = 0;  ///< least friction overcome from the angle of use to `to_deg`
  double weakest_deg = 0;         ///< pilot angle of that least
  /// No choice of the table overcomes more, whatever its price; only where none drives.
  double bound_n_mm_per_mm = 0;
  bool is_proven = true;  ///< false where the search ended before it knew that this is the best
  int nodes = 0, pivots = 0;

  bool drives() const { return !springs.empty(); }
  /// The filling of a sheet with these springs; its other diagonals have none. Springs that drive
  /// the sheet from flat on are relaxed there but for a preload; others have a free length.
  Springs filling(const Mechanism& mechanism, const std::vector<StockSpring>& table) const;
};

/// Chooses springs of `table`. They pull at every angle, or push, so that none is slack. Then as
/// many as possible share the lengths of their links, which are as long as the friction permits.
/// Faults: from_deg beyond the way. Reasons: path_lost.
StudyResult<StockChoice> choose_stock(const Sheet& sheet, const std::vector<StockSpring>& table,
                                      const StockOptions& options);

}  // namespace misalign::solver
