// The lengths that every method is measured against: the same equations in 113-bit arithmetic.
#pragma once

#include <vector>

#include "tests/bench/work_precision/problem.hpp"

namespace misalign::bench {

/// Given are the vertices in mm and the pilot's half angles as doubles, the latter scaled to length
/// one in extended precision; what double or single precision does to either counts as a method's
/// error.
class Truth {
 public:
  explicit Truth(const Problem& problem);

  /// Largest error of any diagonal, mm, of `lengths` at every spacing_deg.
  double largest_error_mm(int sheet, int spacing_deg, const std::vector<double>& lengths) const;

  /// The same at the last sample alone, `lengths` being those of a whole path.
  double last_error_mm(int sheet, const std::vector<double>& lengths) const;

  /// How far the worst loop of the worst state is open.
  double open_by() const { return open_by_; }

 private:
  // A length as the sum of two doubles, 106 bits.
  struct Length {
    double high, low;
  };

  double error_mm(int sheet, int degree, int diagonal, double length) const;
  void refine(const Sheet& sheet, const solver::FoldState<double>& near);

  const Problem& problem_;
  std::vector<Length> lengths_;  // sheet by sheet, degree by degree
  double open_by_ = 0;
};

}  // namespace misalign::bench
