#include "search/draws/trial.hpp"

#include <algorithm>
#include <limits>
#include <ranges>
#include <span>

#include "schema/catalogue/digest.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/stopwatch.hpp"

namespace misalign::search {
namespace {

constexpr std::uint64_t kMostDraws = 4096;       // 2.6 MB on 6 x 6: larger ones are slower
constexpr std::size_t kHistoriesAtOnce = 64;     // of 60 kB each on 6 x 6
constexpr std::uint64_t kMostNumbers = 1 << 21;  // of a block's shifts and diagonals: 16 MB

}  // namespace

std::vector<solver::Verdict> judge_to_the_end(const solver::SheetFamily& family,
                                              solver::Batch& batch,
                                              const solver::ShiftBlock& block) {
  std::vector<solver::Verdict> verdicts = batch.judge(block);
  for (int sheet = 0; sheet < block.sheets; ++sheet) {
    if (verdicts[sheet].first_fault != solver::Fault::undecided) continue;
    const solver::PerforatedSheet& base = family.base();
    const solver::FoldedShape shape(base.sheet, base.holes, family.mechanism());
    solver::FlatVertices vertices_mm;
    family.displace(block.of(sheet), vertices_mm);
    verdicts[sheet] = solver::record_densely(family.mechanism(), shape, family.path(), vertices_mm,
                                             {family.bump_is_fault(), {}})
                          .verdict;
  }
  return verdicts;
}

Trial::Trial(schema::Campaign campaign)
    : Trial(std::move(campaign), solver::available_instruction_sets().back()) {}

Trial::Trial(schema::Campaign campaign, solver::InstructionSet set)
    : campaign_(std::move(campaign)),
      family_(campaign_.pattern.base, campaign_.misalignment.vertices, campaign_.path(),
              campaign_.threshold_sample(), campaign_.between_samples),
      batch_(solver::make_batch(set, family_)) {}

std::uint64_t Trial::largest_block() const {
  const std::uint64_t numbers =
      2 * family_.shifted().size() + 3 * family_.mechanism().diagonals.size();
  return std::clamp<std::uint64_t>(kMostNumbers / numbers, 8, kMostDraws);
}

std::size_t Trial::bytes_of_candidate() const {
  const auto shifts = 2 * static_cast<std::size_t>(family_.mechanism().vertices);
  return sizeof(schema::Candidate) + sizeof(schema::DrawVerdict) +
         sizeof(double) * (shifts + family_.mechanism().diagonals.size() + 2);
}

template <class SomeDraws>
void Trial::displace(const SomeDraws& draws) {
  const std::size_t per_sheet = 2 * family_.shifted().size();
  block_.sheets = static_cast<int>(std::size(draws));
  block_.shifts_mm.resize(per_sheet * std::size(draws));
  double* shifts_mm = block_.shifts_mm.data();
  for (const std::uint64_t draw : draws) {
    draw_shifts(campaign_.misalignment, campaign_.seed, draw, shifts_mm);
    shifts_mm += per_sheet;
  }
}

void Trial::screen(const schema::DrawRange& block, schema::UnitRecord& unit,
                   const schema::FaultSampleRule& sampled) {
  const auto draws = std::views::iota(block.lo, block.hi);
  displace(draws);
  const std::vector<solver::Screened>& screened = batch_->screen(block_);
  for (const std::uint64_t draw : draws) {
    const solver::Screened& seen = screened[draw - block.lo];
    if (seen.fault == solver::Fault::none || sampled.holds(draw)) {
      waiting_.push_back(draw);
    } else {
      ++unit.rejected;
      ++unit.screened[{static_cast<int>(seen.fault), seen.sample}];
    }
  }
}

void Trial::settle(schema::UnitRecord& unit, const schema::FaultSampleRule& sampled) {
  displace(waiting_);
  verdicts_ = judge_to_the_end(family_, *batch_, block_);
  Draws accepted;
  for (std::size_t k = 0; k < waiting_.size(); ++k) {
    const std::uint64_t draw = waiting_[k];
    const solver::Verdict& verdict = verdicts_[k];
    if (sampled.holds(draw)) unit.fault_sample.push_back({draw, verdict});
    if (verdict.first_fault == solver::Fault::undecided) {
      unit.undecided.push_back({draw, verdict});
    } else if (campaign_.accepts(verdict)) {
      accepted.push_back(draw);
    } else {
      ++unit.rejected;
      ++unit.screened[{static_cast<int>(verdict.first_fault), verdict.fault_sample()}];
    }
  }
  waiting_.clear();
  add_candidates(accepted, unit);
}

void Trial::add_candidates(const Draws& accepted, schema::UnitRecord& unit) {
  solver::FlatVertices vertices_mm;
  for (std::size_t first = 0; first < accepted.size(); first += kHistoriesAtOnce) {
    const std::span some =
        std::span(accepted).subspan(first, std::min(kHistoriesAtOnce, accepted.size() - first));
    displace(some);
    const std::vector<solver::FoldingHistory>& histories = batch_->record(block_);
    for (std::size_t k = 0; k < some.size(); ++k) {
      family_.displace(block_.of(static_cast<int>(k)), vertices_mm);
      const auto metrics =
          solver::measure(family_.base(), vertices_mm, histories[k], campaign_.sample_deg);
      unit.candidates.push_back({some[k], metrics, shifts_mm(some[k])});
      ++unit.accepted;
    }
  }
}

const std::vector<solver::Verdict>& Trial::judge(const schema::DrawRange& block) {
  displace(std::views::iota(block.lo, block.hi));
  verdicts_ = judge_to_the_end(family_, *batch_, block_);
  return verdicts_;
}

solver::FoldingHistory Trial::history(std::uint64_t draw) {
  displace(Draws{draw});
  return std::move(batch_->record(block_).front());
}

Eigen::Matrix2Xd Trial::shifts_mm(std::uint64_t draw) const {
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, family_.mechanism().vertices);
  draw_shifts(campaign_.misalignment, campaign_.seed, draw, shifts_mm);
  return shifts_mm;
}

std::string golden_verdicts(solver::InstructionSet set) {
  Trial trial(
      schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                             {"accept", {{"deploys_from_deg", 180}}}},
                            "the golden campaign"),
      set);
  std::string whole_numbers;
  for (const solver::Verdict& verdict : trial.judge({0, 32})) {
    whole_numbers += std::to_string(verdict.deploys_from_sample) +
                     solver::fault_name(verdict.first_fault) + std::to_string(verdict.where) + " ";
  }
  return schema::hex(schema::hash_of(whole_numbers));
}

UnitWork::UnitWork(Trial& trial, const schema::DrawRange& range,
                   const schema::FaultSampleRule& sampled, std::size_t most_bytes)
    : trial_(trial),
      range_(range),
      sampled_(sampled),
      most_bytes_(most_bytes),
      next_(range.lo),
      seconds_per_path_(std::numeric_limits<double>::infinity()) {
  record_.range = {range.lo, range.lo};
}

bool UnitWork::is_full() const {
  const std::size_t candidates = record_.candidates.size() + trial_.waiting();
  const std::size_t verdicts = record_.undecided.size() + record_.fault_sample.size();
  return candidates * trial_.bytes_of_candidate() + verdicts * sizeof(schema::DrawVerdict) >=
         most_bytes_;
}

void UnitWork::run_next_block() {
  constexpr double kShort_s = 0.015, kLong_s = 0.08, kPaths_s = 0.08;
  const Stopwatch watch;
  const std::uint64_t draws = std::min(block_draws_, range_.hi - next_);
  trial_.screen({next_, next_ + draws}, record_, sampled_);
  next_ += draws;
  record_.range.hi = next_;
  if (finished() || static_cast<double>(trial_.waiting()) * seconds_per_path_ > kPaths_s) settle();
  record_.seconds += watch.seconds();
  if (watch.seconds() < kShort_s) block_draws_ = std::min(2 * block_draws_, trial_.largest_block());
  if (watch.seconds() > kLong_s) block_draws_ = std::max<std::uint64_t>(block_draws_ / 2, 1);
}

void UnitWork::settle() {
  if (trial_.waiting() == 0) return;
  const double paths = static_cast<double>(trial_.waiting());
  const Stopwatch watch;
  trial_.settle(record_, sampled_);
  seconds_per_path_ = watch.seconds() / paths;
}

schema::UnitRecord UnitWork::take() {
  const Stopwatch watch;
  settle();
  record_.seconds += watch.seconds();
  return std::move(record_);
}

namespace {

schema::UnitRecord worked_off(UnitWork work) {
  while (!work.finished()) work.run_next_block();
  return work.take();
}

}  // namespace

schema::UnitRecord work_off(Trial& trial, const schema::DrawRange& range) {
  return worked_off(UnitWork(trial, range));
}

schema::UnitRecord judge_again(Trial& trial, std::uint64_t draw) {
  const schema::FaultSampleRule densest(1);
  return worked_off(UnitWork(trial, {draw, draw + 1}, densest));
}

}  // namespace misalign::search
