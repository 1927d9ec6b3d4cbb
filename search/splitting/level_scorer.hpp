// Scores sheets that may reach a level.
#pragma once

#include <list>
#include <memory>

#include "schema/campaign/campaign.hpp"
#include "schema/records/unit_record.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {

/// Marks instead of a score: certainly below the requested level; a numerical failure.
inline constexpr int kBelow = -1, kUndecided = -2;

/// Returns the score of a campaign's last level, its criterion.
int last_level(const schema::Campaign& campaign);
/// Returns a verdict's score in this campaign: kScoresPerSample per sample, see solver::score. A
/// rejected sheet lies below the last level, one with an inactive diagonal below every level.
int score_of(const solver::Verdict& verdict, const schema::Campaign& campaign);

/// Applies rejection tests at a level's sample, and follows full paths of the remaining sheets.
class LevelScorer {
 public:
  /// `campaign` must outlive this object.
  LevelScorer(const schema::Campaign& campaign, int sample, solver::InstructionSet set);

  /// Returns the scores of all sheets above the level's sample; those of others may be kBelow.
  const std::vector<int>& score(const solver::ShiftBlock& block);

 private:
  const schema::Campaign& campaign_;
  const solver::Model model_;
  std::unique_ptr<solver::Batch> batch_;
  solver::ShiftBlock open_;
  std::vector<int> scores_;
};

/// The scorers of levels, and the model that measures candidates, each made when first needed.
/// Scorers are large, and take 25 ms to make on 10 x 10 panels (20 ms on 6 x 6), where pieces take
/// 2 s: only the last used are kept.
class LevelScorers {
 public:
  static constexpr std::size_t kMostScorers = 2;

  LevelScorers(const schema::Campaign& campaign, solver::InstructionSet set)
      : campaign_(campaign), set_(set) {}
  /// Returns the scorer of sheets that may have this score, or a higher one.
  LevelScorer& from(int score);
  /// Measures sheets that meet the criterion, as plain draws are measured.
  std::vector<schema::Candidate> measured(const solver::ShiftBlock& shifts);
  /// Returns the campaign's model.
  const solver::Model& model();
  const schema::Campaign& campaign() const { return campaign_; }

 private:
  const schema::Campaign& campaign_;
  const solver::InstructionSet set_;
  struct OfSample {
    int sample;
    std::unique_ptr<LevelScorer> scorer;
  };
  std::list<OfSample> scorers_;  // the last used comes first
  std::unique_ptr<const solver::Model> model_;
  std::unique_ptr<solver::Batch> batch_;
};

}  // namespace misalign::search
