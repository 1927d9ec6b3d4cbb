#include "search/splitting/piece.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "search/terminal/stopwatch.hpp"

namespace misalign::search {
namespace {

// Largest block: more are no faster, and a signal waits for a step of a block.
constexpr std::uint32_t kMostOfBlock = 1024;

}  // namespace

void PieceResult::append(PieceResult next) {
  assert(next.lo == hi);
  hi = next.hi;
  tried += next.tried;
  taken += next.taken;
  undecided += next.undecided;
  seconds += next.seconds;
  survivors.insert(survivors.end(), next.survivors.begin(), next.survivors.end());
  there.add(next.there);
  std::ranges::move(next.met, std::back_inserter(met));
}

bool PieceResult::are_all_from(int score) const {
  return std::ranges::all_of(there.scores, [&](int reached) { return reached >= score; });
}

bool PieceResult::has_one_each() const {
  if (met.size() != hi - lo) return false;
  return std::ranges::all_of(
      met, [&](const MetCandidate& end) { return end.particle == lo + (&end - met.data()); });
}

PieceWork::PieceWork(const Moves& moves, std::uint32_t sweeps, LevelScorers& scorers,
                     BeginAscent ascend, PieceOrder order)
    : moves_(moves),
      sweeps_(sweeps),
      scorers_(scorers),
      order_(std::move(order)),
      bytes_(moves.code().bytes()),
      next_(order_.lo) {
  assert(order_.lo <= order_.hi && order_.within <= order_.next);
  assert(order_.is_first || order_.here.count() + order_.starts.size() == order_.hi - order_.lo);
  result_.population = order_.population;
  result_.level = order_.level;
  result_.lo = result_.hi = order_.lo;
  if (order_.starts.empty()) return;
  assert(ascend);
  schema::UnitRecord starts;
  starts.candidates = order_.starts;
  ascents_.emplace(ascend, scorers.campaign(), scorers.model()).begin(std::move(starts));
}

void PieceWork::run_next_block() {
  assert(!finished());
  if (ascents_) return advance_ascents();
  const Stopwatch watch;
  if (block_ == 0) begin_block();
  make_proposals();
  take_good_ones();
  of_block_.seconds += watch.seconds();
  if (order_.is_first || ++step_ > sweeps_) end_block();
}

void PieceWork::advance_ascents() {
  const Stopwatch watch;
  ascents_->advance([&](schema::Candidate& end) {
    result_.met.push_back({1, next_, std::move(end)});
    ++result_.tried;
    result_.hi = ++next_;
  });
  result_.seconds += watch.seconds();
}

void PieceWork::begin_block() {
  block_ = std::min(kMostOfBlock, order_.hi - next_);
  step_ = order_.is_first ? 0 : 1;
  of_block_ = {};
  if (order_.is_first) {
    now_ = Particles::of(bytes_, block_);
    now_scores_.assign(block_, kBelow);
    return;
  }
  now_.clear();
  for (std::uint32_t k = 0; k < block_; ++k) now_.add(order_.here.sheets[next_ - order_.lo + k]);
  const auto first = order_.here.scores.begin() + (next_ - order_.lo);
  now_scores_.assign(first, first + block_);
}

void PieceWork::make_proposals() {
  tried_ = now_;
  shifts_.sheets = static_cast<int>(block_);
  shifts_.shifts_mm.resize(block_ * moves_.code().shifts());
  for (std::uint32_t k = 0; k < block_; ++k) {
    const StepWords words(scorers_.campaign().seed, order_.population, order_.level, step_,
                          next_ + k);
    if (order_.is_first) {
      moves_.draw(words, tried_[k]);
    } else {
      moves_.propose(words, tried_[k]);
    }
    moves_.code().write_mm(tried_[k], shifts_.shifts_mm.data() + k * moves_.code().shifts());
  }
}

// Takes first draws that reach the next level, and moves that stay within their level.
void PieceWork::take_good_ones() {
  const int least = order_.is_first ? order_.next : order_.within;
  const std::vector<int>& scores = scorers_.from(least).score(shifts_);
  assert(scores.size() == block_ && now_scores_.size() == block_);
  const int accepted = last_level(scorers_.campaign());
  for (std::uint32_t k = 0; k < block_; ++k) {
    ++of_block_.tried;
    of_block_.undecided += scores[k] == kUndecided;
    if (scores[k] < least) continue;
    ++of_block_.taken;
    std::ranges::copy(std::as_const(tried_)[k], now_[k].begin());
    now_scores_[k] = scores[k];
    if (!order_.is_catalogued || scores[k] < accepted) continue;
    const ShiftCode::ConstParticle sheet = std::as_const(tried_)[k];
    met_.push_back({step_, next_ + k, {sheet.begin(), sheet.end()}});
  }
}

// Measures new sheets among those met.
void PieceWork::collect_met() {
  solver::ShiftBlock shifts;
  const std::size_t each = moves_.code().shifts(), known = result_.met.size();
  for (const Met& met : met_) {
    const auto [at, is_new] =
        place_.try_emplace({met.sheet.begin(), met.sheet.end()}, result_.met.size());
    if (is_new) {
      result_.met.push_back({met.step, met.particle, {}});
      shifts.shifts_mm.resize(shifts.shifts_mm.size() + each);
      moves_.code().write_mm(met.sheet, shifts.shifts_mm.data() + shifts.shifts_mm.size() - each);
      ++shifts.sheets;
    } else {
      MetCandidate& first = result_.met[at->second];
      std::tie(first.step, first.particle) =
          std::min(std::pair(first.step, first.particle), std::pair(met.step, met.particle));
    }
  }
  met_.clear();
  if (shifts.sheets == 0) return;
  std::vector<schema::Candidate> candidates = scorers_.measured(shifts);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    result_.met[known + k].candidate = std::move(candidates[k]);
  }
}

void PieceWork::end_block() {
  const Stopwatch watch;
  collect_met();
  of_block_.seconds += watch.seconds();
  of_block_.lo = next_;
  next_ += block_;
  of_block_.hi = next_;
  for (std::uint32_t k = 0; k < block_; ++k) {
    if (now_scores_[k] < order_.next) continue;
    of_block_.survivors.push_back(of_block_.lo + k);
    of_block_.there.sheets.add(std::as_const(now_)[k]);
    of_block_.there.scores.push_back(now_scores_[k]);
  }
  result_.append(std::move(of_block_));
  block_ = 0;
}

PieceResult PieceWork::take() { return std::move(result_); }

}  // namespace misalign::search
