// An invented science of draws that fills a catalogue's columns as the campaign miura-6x6 does: a
// million candidates in a minute instead of two hours.
#pragma once

#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue.hpp"

namespace misalign::bench {

/// What became of the draws of a unit.
struct UnitContents {
  std::uint64_t candidates = 0, sampled = 0;
  /// How many (cause, degree) the tests that judge draws saw; 200 in a real unit of a second.
  int screened = 0;
};

class InventedDraws {
 public:
  explicit InventedDraws(unsigned seed);

  schema::Candidate candidate(std::uint64_t draw);
  schema::DrawVerdict sampled(std::uint64_t draw);
  /// Candidates and sampled draws spread evenly over the range, which must be large enough.
  schema::UnitRecord unit(const schema::DrawRange& range, const UnitContents& contents);

  const schema::Campaign& campaign() const { return campaign_; }
  const solver::Mechanism& mechanism() const { return mechanism_; }

 private:
  double exponential(double mean) { return std::exponential_distribution(1 / mean)(random_); }

  const schema::Campaign campaign_ = schema::default_campaign();
  const solver::Mechanism mechanism_;
  std::mt19937_64 random_;
};

/// A run of this program, for a catalogue.
schema::RunInfo invented_run(int ranks);

}  // namespace misalign::bench
