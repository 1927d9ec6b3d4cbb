// The study of tolerance: the share of miscut copies of a sheet that still deploy.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/pattern/crease_pattern.hpp"
#include "solver/play/miscut_stops.hpp"
#include "solver/play/quantile.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// Verdicts on miscut copies, counted.
struct MiscutCopies {
  std::uint64_t trials = 0;
  std::uint64_t undecided = 0;           ///< numerical failures
  std::vector<std::uint64_t> of_sample;  ///< decided copies, counted by D
  MiscutStops stops;                     ///< stops of all copies, if they are asked for

  void add(const Verdict& verdict);
  void add(const MiscutCopies& others);
  std::uint64_t decided() const { return trials - undecided; }
  /// Number of decided copies that deploy from this sample, or from a later one.
  std::uint64_t from(int sample) const;
  /// Quantile of D over the decided copies, of which there is at least one: 0.5 is the median.
  int quantile(double share) const;
  /// Mean of D over the decided copies.
  double mean_sample() const;
};

struct Tolerance {
  struct Vertex {
    int vertex;
    MiscutCopies copies;  ///< copies with only this vertex miscut
  };

  double amplitude_mm;
  double sample_deg, threshold_deg;
  int threshold_sample;
  int own_sample;  ///< D of the uncut sheet
  MiscutCopies copies;
  std::vector<Vertex> vertices;     ///< the most harmful first; empty unless requested
  double rest_deg = 0;              ///< pilot angle of its filling's rest; 0: relaxed flat
  double friction_n_mm_per_mm = 0;  ///< dry friction of the sheet's creases
  bool has_shapes = false;          ///< stops have distances from a target
  std::optional<Stop> own_stop;     ///< the sheet's, by which copies have stops, too

  /// Number of copies that deploy from the campaign's threshold.
  std::uint64_t survivors() const { return copies.from(threshold_sample); }
  double mean_loss_deg(const MiscutCopies& some) const {
    return (own_sample - some.mean_sample()) * sample_deg;
  }
};

/// Errors must be smaller than this, mm: with larger ones a facet of the sheet with these shifts
/// (one column per vertex) can lose its convexity.
double largest_miscut_mm(const CreasePattern& base, const Eigen::Matrix2Xd& shifts_mm);

}  // namespace misalign::solver
