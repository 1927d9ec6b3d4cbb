#include "search/ranks/climb_task.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "search/ranks/departure.hpp"
#include "search/ranks/piece_messages.hpp"
#include "search/splitting/origin.hpp"

namespace misalign::search {
namespace {

// Converts numbers, which the catalogue's goal and ledger count, to populations.
DrawRange populations_of(const DrawRange& numbers) {
  return {numbers.lo / schema::kNumbersOfPopulation, numbers.hi / schema::kNumbersOfPopulation};
}

Ledger ledger_of(const schema::Catalogue& catalogue, const schema::Goal& goal) {
  std::vector<DrawRange> done;
  for (const DrawRange& numbers : catalogue.done()) done.push_back(populations_of(numbers));
  return {populations_of({goal.range.lo, catalogue.goal_end()}), done};
}

// Least interval between commits of pieces, which a kill can cost besides the pieces under way.
constexpr double kCommitEvery_s = 2;

}  // namespace

ClimbTask::ClimbTask(Climber& climber, schema::Catalogue& catalogue, const schema::Goal& goal,
                     int ranks)
    : climber_(climber),
      catalogue_(catalogue),
      splitting_(*climber.campaign().search.splitting),
      limited_(goal.planned_end() < schema::kEndOfDraws),
      dispatcher_(stored_ladder(climber.campaign(), catalogue.levels()),
                  last_level(climber.campaign()), ledger_of(catalogue, goal), ranks,
                  climber.campaign().stop.accepted.value_or(kAllSheets)),
      standing_(catalogue.standing()) {
  if (catalogue.levels().empty() && !dispatcher_.ladder().scores.empty()) write_levels();
  restore();
}

// Skips pieces of populations that are in the ledger, or that another build made.
void ClimbTask::restore() {
  for (const schema::PieceRow& row : catalogue_.pieces(piece_layout())) {
    auto result = unpack_kept(catalogue_.result_of(row), climber_.campaign(),
                              climber_.moves().code(), climber_.mechanism());
    const bool is_row = result && result->population == row.population &&
                        result->level == row.level && result->lo == row.lo && result->hi == row.hi;
    if (is_row) {
      dispatcher_.restore(std::move(*result));
    } else {
      spdlog::warn(
          "population {}: particles {} to {} at level {} are damaged in the catalogue; they are "
          "computed again",
          row.population, row.lo, row.hi, row.level);
    }
    if (dispatcher_.take_news_of_levels()) write_levels();
  }
  commit();
}

void ClimbTask::write_levels() {
  catalogue_.keep_levels(dispatcher_.ladder().scores, LevelFinder::kNumber);
  std::erase_if(waiting_,
                [](const schema::PieceRow& row) { return row.population == LevelFinder::kNumber; });
}

std::optional<Bytes> ClimbTask::assign(int worker) {
  const auto order = dispatcher_.assign(worker);
  return order ? std::optional(pack(*order)) : std::nullopt;
}

bool ClimbTask::take_back(int worker, const Bytes& result) {
  SentPiece sent = unpack_piece(result);
  take_back(worker, std::move(sent.result));
  return sent.was_stopped;
}

void ClimbTask::take_back(int worker, PieceResult result) {
  if (result.hi > result.lo) {
    const Bytes bytes = pack(SentPiece{result, false});
    waiting_.push_back({result.population,
                        result.level,
                        result.lo,
                        result.hi,
                        piece_layout(),
                        {bytes.begin(), bytes.end()}});
  }
  rows_ += 1 + result.met.size();
  dispatcher_.finish(worker, std::move(result));
}

bool ClimbTask::compute_one_block() {
  if (!own_work_) {
    if (auto order = dispatcher_.assign(0)) own_work_.emplace(climber_.start(std::move(*order)));
  }
  if (!own_work_) return false;
  {
    const MayBeLeft computing;
    own_work_->run_next_block();
  }
  if (own_work_->finished()) hand_in_own();
  return true;
}

void ClimbTask::hand_in_own() {
  if (!own_work_) return;
  PieceResult result = own_work_->take();
  own_work_.reset();
  take_back(0, std::move(result));
}

// Commits populations at once, and pieces of others now and then.
void ClimbTask::commit() {
  rows_ = 0;
  if (dispatcher_.take_news_of_levels()) write_levels();
  std::vector<schema::UnitRecord> units;
  for (PopulationRecord& record : dispatcher_.take_done()) {
    std::erase_if(waiting_,
                  [&](const schema::PieceRow& row) { return row.population == record.population; });
    units.push_back(unit_of(std::move(record)));
    standing_.add(units.back());
    ++populations_of_run_;
  }
  if (!units.empty()) catalogue_.commit(units);
  dispatcher_.cut(catalogue_.goal_end() / schema::kNumbersOfPopulation);
  if (since_commit_.seconds() < kCommitEvery_s) return;
  commit_pieces();
}

void ClimbTask::commit_all() {
  commit();
  commit_pieces();
}

void ClimbTask::commit_pieces() {
  if (waiting_.empty()) return;
  catalogue_.keep_pieces(std::exchange(waiting_, {}));
  since_commit_ = Stopwatch();
}

schema::UnitRecord ClimbTask::unit_of(PopulationRecord record) const {
  schema::UnitRecord unit;
  unit.range = schema::numbers_of({record.population, std::uint64_t{record.population} + 1});
  for (FoundCandidate& found : record.found) {
    found.candidate.draw = number_of(found.origin, splitting_);
    unit.candidates.push_back(std::move(found.candidate));
  }
  unit.accepted = unit.candidates.size();
  unit.rejected = unit.range.size() - unit.accepted;
  for (const schema::LevelCount& level : record.levels) unit.seconds += level.seconds;
  unit.levels = std::move(record.levels);
  return unit;
}

ProgressCounts ClimbTask::counts() const {
  ProgressCounts counts{standing_, populations_of_run_, dispatcher_.populations_left(), limited_};
  counts.standing.draws /= schema::kNumbersOfPopulation;
  counts.of = "populations";
  counts.under_way = dispatcher_.under_way();
  return counts;
}

}  // namespace misalign::search
