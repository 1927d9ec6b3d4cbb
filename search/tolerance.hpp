// `misalign tolerance`: how a candidate fares when every vertex is cut a little beside its place.
#pragma once

#include "search/trial.hpp"

namespace misalign::search {

/// Errors of trial t, mm: x and y of every vertex of the sheet, uniform on [-amplitude, amplitude].
/// The same for every candidate of a campaign: stream 1 of the draws' generator, with t in the
/// draw's place.
void trial_errors(const schema::Campaign& campaign, double amplitude_mm, std::uint64_t trial,
                  double* errors_mm);

/// Verdicts on miscut copies, counted.
struct MiscutCopies {
  std::uint64_t trials = 0;
  std::uint64_t undecided = 0;       ///< numerical failures: neither yes nor no
  std::uint64_t from_threshold = 0;  ///< that deploy from the campaign's threshold
  std::uint64_t from_own = 0;        ///< that deploy from the candidate's own D
  std::vector<int> samples;          ///< D of the decided ones, ascending

  void add(const solver::Verdict& verdict, int threshold_sample, int own_sample);
  /// The D that this share of the decided ones stays at or below, at least one: 0.5 is the median.
  int quantile(double share) const;
  /// Sum of D over the decided ones, divided by their number.
  double mean_sample() const;
};

/// A share with its 95 % interval, in which the undecided ones may all be hits or none.
struct ShareOfTrials {
  double share;  ///< of the decided ones
  double low, high;
};
ShareOfTrials share_of(std::uint64_t hits, const MiscutCopies& copies);

struct VertexTolerance {
  int vertex;
  MiscutCopies copies;  ///< in which this vertex alone is off its place
};

struct Tolerance {
  std::uint64_t draw;
  double amplitude_mm;
  double sample_deg, threshold_deg;
  int own_sample;  ///< the candidate's D
  MiscutCopies copies;
  std::vector<VertexTolerance> vertices;  ///< the most harmful first

  double mean_loss_deg(const MiscutCopies& some) const {
    return (own_sample - some.mean_sample()) * sample_deg;
  }
};

/// Trials with one vertex alone are made no more than this.
inline constexpr std::uint64_t kMostTrialsOfOneVertex = 200;

/// Trials 0 to `trials` of a draw that deploys, in the registers of `set`. UserError (2) if a facet
/// could lose convexity.
Tolerance study_tolerance(const schema::Campaign& campaign, std::uint64_t draw, double amplitude_mm,
                          std::uint64_t trials, solver::InstructionSet set);

std::string tolerance_text(const Tolerance& tolerance);
schema::Json tolerance_json(const Tolerance& tolerance);

}  // namespace misalign::search
