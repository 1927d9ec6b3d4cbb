// Records the results of draws for a catalogue.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "schema/campaign/draw_range.hpp"
#include "schema/records/ascent_record.hpp"
#include "schema/records/certificate_record.hpp"
#include "schema/records/level_count.hpp"
#include "solver/records/metrics.hpp"

namespace misalign::schema {

/// A row for table fault_sample or undecided.
struct DrawVerdict {
  std::uint64_t draw;
  solver::Verdict verdict;
};

struct Candidate {
  std::uint64_t draw;
  solver::Metrics metrics;
  Eigen::Matrix2Xd shifts_mm;  ///< one column per vertex of the sheet
  std::optional<CertificateRecord> certificate = {};
  std::optional<AscentRecord> ascent = {};  ///< the sheet is the optimum; searches with ends only
};

/// Results of a range of draws: a unit of the ledger with all its rows.
struct UnitRecord {
  DrawRange range;
  int worker = 0;  ///< rank that computed it
  std::uint64_t accepted = 0, rejected = 0;
  double seconds = 0;
  double tables_deg = 0;                  ///< column tables_deg of a run; 0: no tables
  std::vector<Candidate> candidates;      ///< ascending
  std::vector<DrawVerdict> undecided;     ///< ascending
  std::vector<DrawVerdict> fault_sample;  ///< ascending; see FaultSampleRule
  std::map<std::pair<int, int>, std::uint64_t> screened;  ///< (Fault, sample) -> draws
  std::vector<LevelCount> levels;                         ///< levels of a population, from 0 on

  /// Counts a rejected draw.
  void reject(solver::Fault fault, int sample);
  /// Adds a draw that is not accepted.
  void turn_down(std::uint64_t draw, const solver::Verdict& verdict);
  std::vector<std::uint64_t> accepted_draws() const, undecided_draws() const;
  /// Adds the results of the range behind this one.
  void add(UnitRecord&& next);
};

}  // namespace misalign::schema
