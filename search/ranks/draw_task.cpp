#include "search/ranks/draw_task.hpp"

#include <algorithm>
#include <utility>

#include "search/ranks/departure.hpp"

namespace misalign::search {

DrawTask::DrawTask(DrawEvaluator& evaluator, schema::Catalogue& catalogue, const schema::Goal& goal,
                   int ranks, const DrawTaskOptions& options)
    : evaluator_(evaluator),
      catalogue_(catalogue),
      options_(options),
      limited_(goal.planned_end() < schema::kEndOfDraws),
      dispatcher_({{goal.range.lo, catalogue.goal_end()}, catalogue.done()}, ranks,
                  options.unit_size),
      standing_(catalogue.standing()) {}

std::optional<Bytes> DrawTask::assign(int worker) {
  const auto range = dispatcher_.assign(worker);
  return range ? std::optional(pack(*range)) : std::nullopt;
}

bool DrawTask::take_back(int worker, const Bytes& result) {
  SentUnit sent = unpack_unit(result);
  sent.unit.worker = worker;
  take_back(std::move(sent.unit));
  return sent.was_stopped;
}

void DrawTask::take_back(schema::UnitRecord unit) {
  dispatcher_.finish(unit.worker, unit.range.hi, unit.seconds);
  rows_ += 1 + unit.candidates.size() + unit.fault_sample.size();
  waiting_.push_back(std::move(unit));
}

bool DrawTask::compute_one_block() {
  if (!own_work_) {
    if (const auto range = dispatcher_.assign(0))
      own_work_.emplace(evaluator_, *range, schema::FaultSampleRule(), options_.unit_bytes);
  }
  if (!own_work_) return false;
  {
    const MayBeLeft computing;
    own_work_->run_next_block();
  }
  if (own_work_->finished() || own_work_->is_full()) hand_in_own();
  return true;
}

void DrawTask::hand_in_own() {
  if (!own_work_) return;
  schema::UnitRecord unit = own_work_->take();
  own_work_.reset();
  take_back(std::move(unit));
}

void DrawTask::commit() {
  std::vector<schema::UnitRecord> units = std::exchange(waiting_, {});
  rows_ = 0;
  std::erase_if(units, [](const schema::UnitRecord& unit) { return unit.range.size() == 0; });
  for (const schema::UnitRecord& unit : units) {
    draws_of_run_ += unit.range.size();
    standing_.add(unit);
  }
  if (!units.empty()) catalogue_.commit(units);
  dispatcher_.cut(catalogue_.goal_end());
}

ProgressCounts DrawTask::counts() const {
  ProgressCounts counts{standing_, draws_of_run_, dispatcher_.draws_left(), limited_};
  if (!own_work_) return counts;
  const std::uint64_t draws = own_work_->so_far().range.size();
  counts.standing.add(own_work_->so_far());
  counts.draws_of_run += draws;
  counts.draws_left -= std::min(draws, counts.draws_left);  // the goal may have been cut
  return counts;
}

}  // namespace misalign::search
