// Scores sheets that may reach a level.
#pragma once

#include <list>
#include <memory>

#include "schema/campaign/campaign.hpp"
#include "schema/records/unit_record.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {

/// Instead of a score: below the level that was asked for, for certain; or a numerical failure.
inline constexpr int kBelow = -1, kUndecided = -2;

/// The score of a campaign's last level: its criterion.
int last_level(const schema::Campaign& campaign);
/// A verdict's score in this campaign: kScoresPerSample a sample, see solver::score. A sheet that
/// is not accepted lies below the last level, one with an inactive diagonal below every level.
int score_of(const solver::Verdict& verdict, const schema::Campaign& campaign);

/// Rejection tests at a level's own sample, and full paths of those that they leave.
class LevelScorer {
 public:
  /// `campaign` must outlive this object.
  LevelScorer(const schema::Campaign& campaign, int sample, solver::InstructionSet set);

  /// The scores of all sheets that lie above the level's sample; of others perhaps kBelow.
  const std::vector<int>& score(const solver::ShiftBlock& block);

 private:
  const schema::Campaign& campaign_;
  const solver::Model model_;
  std::unique_ptr<solver::Batch> batch_;
  solver::ShiftBlock open_;
  std::vector<int> scores_;
};

/// The judges of levels, and what measures candidates, each made when first needed. Judges are
/// large, and made in some 25 ms on 10 x 10 panels (20 ms on 6 x 6), where pieces take 2 s: only
/// those that were used last are kept.
class LevelScorers {
 public:
  static constexpr std::size_t kMostScorers = 2;

  LevelScorers(const schema::Campaign& campaign, solver::InstructionSet set)
      : campaign_(campaign), set_(set) {}
  /// Of the sheets whose score may be `score`, or more.
  LevelScorer& from(int score);
  /// Of sheets that meet the criterion, as of plain draws.
  std::vector<schema::Candidate> measured(const solver::ShiftBlock& shifts);
  /// The campaign's own.
  const solver::Model& model();
  const schema::Campaign& campaign() const { return campaign_; }

 private:
  const schema::Campaign& campaign_;
  const solver::InstructionSet set_;
  struct OfSample {
    int sample;
    std::unique_ptr<LevelScorer> scorer;
  };
  std::list<OfSample> scorers_;  // the one that was used last is the first
  std::unique_ptr<const solver::Model> model_;
  std::unique_ptr<solver::Batch> batch_;
};

}  // namespace misalign::search
