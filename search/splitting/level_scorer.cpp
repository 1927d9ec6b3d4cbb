#include "search/splitting/level_scorer.hpp"

#include <algorithm>

#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"

namespace misalign::search {

int last_level(const schema::Campaign& campaign) {
  return solver::kScoresPerSample * campaign.threshold_sample();
}

int score_of(const solver::Verdict& verdict, const schema::Campaign& campaign) {
  if (verdict.first_fault == solver::Fault::undecided) return kUndecided;
  if (campaign.accepts(verdict)) return verdict.score;
  return std::min(verdict.score, last_level(campaign) - 1);
}

LevelScorer::LevelScorer(const schema::Campaign& campaign, int sample, solver::InstructionSet set)
    : campaign_(campaign),
      model_(scoring_model_of(campaign, sample)),
      batch_(solver::make_batch(set, model_)) {}

const std::vector<int>& LevelScorer::score(const solver::ShiftBlock& block) {
  const auto sheets = static_cast<std::size_t>(block.sheets);
  const std::size_t shifts = block.shifts_mm.size() / std::max<std::size_t>(sheets, 1);
  scores_.assign(sheets, kBelow);
  open_.shifts_mm.clear();
  open_.sheets = 0;
  std::vector<std::size_t> open;
  if (model_.threshold_sample() > 0) {
    const std::vector<solver::Rejection>& seen = batch_->reject(block);
    for (std::size_t k = 0; k < sheets; ++k) {
      if (seen[k].fault == solver::Fault::none) open.push_back(k);
    }
  } else {
    for (std::size_t k = 0; k < sheets; ++k) open.push_back(k);
  }
  for (const std::size_t k : open) {
    const double* const shifts_mm = block.of(static_cast<int>(k));
    open_.shifts_mm.insert(open_.shifts_mm.end(), shifts_mm, shifts_mm + shifts);
    ++open_.sheets;
  }
  if (open.empty()) return scores_;
  const std::vector<solver::Verdict>& verdicts = batch_->judge(open_);
  for (std::size_t k = 0; k < open.size(); ++k) scores_[open[k]] = score_of(verdicts[k], campaign_);
  return scores_;
}

LevelScorer& LevelScorers::from(int score) {
  const int sample = score / solver::kScoresPerSample;
  const auto at = std::ranges::find(scorers_, sample, &OfSample::sample);
  if (at != scorers_.end()) {
    scorers_.splice(scorers_.begin(), scorers_, at);
  } else {
    if (scorers_.size() == kMostScorers) scorers_.pop_back();
    scorers_.push_front({sample, std::make_unique<LevelScorer>(campaign_, sample, set_)});
  }
  return *scorers_.front().scorer;
}

std::vector<schema::Candidate> LevelScorers::measured(const solver::ShiftBlock& shifts) {
  if (!batch_) batch_ = solver::make_batch(set_, model());
  return search::measured(model(), *batch_, shifts);
}

const solver::Model& LevelScorers::model() {
  if (!model_) model_.reset(new solver::Model(model_of(campaign_)));
  return *model_;
}

}  // namespace misalign::search
