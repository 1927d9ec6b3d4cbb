#include "search/trial.hpp"

#include <algorithm>
#include <chrono>

#include "search/draw.hpp"

namespace misalign::search {
namespace {

constexpr std::uint64_t kMostDraws = 16384;
constexpr std::ptrdiff_t kHistoriesAtOnce = 64;  // of 60 kB each on 6 x 6
constexpr std::uint64_t kMostNumbers = 1 << 21;  // of a block's shifts and diagonals: 16 MB

bool is_sampled(std::uint64_t draw) { return draw % schema::kFaultSampleEvery == 0; }

}  // namespace

Trial::Trial(schema::Campaign campaign)
    : Trial(std::move(campaign), solver::available_instruction_sets().back()) {}

Trial::Trial(schema::Campaign campaign, solver::InstructionSet set)
    : campaign_(std::move(campaign)),
      family_(campaign_.pattern.base, campaign_.misalignment.vertices, campaign_.path(),
              campaign_.threshold_sample()),
      batch_(solver::make_batch(set, family_)),
      reference_(family_.mechanism(), family_.path()) {}

std::uint64_t Trial::largest_block() const {
  const std::uint64_t numbers =
      2 * family_.shifted().size() + 3 * family_.mechanism().diagonals.size();
  return std::clamp<std::uint64_t>(kMostNumbers / numbers, 8, kMostDraws);
}

void Trial::displace(const schema::DrawRange& block) {
  const std::size_t per_sheet = 2 * family_.shifted().size();
  block_.sheets = static_cast<int>(block.size());
  block_.shifts_mm.resize(per_sheet * block.size());
  double* shifts_mm = block_.shifts_mm.data();
  for (std::uint64_t draw = block.lo; draw < block.hi; ++draw, shifts_mm += per_sheet) {
    draw_shifts(campaign_.misalignment, campaign_.seed, draw, shifts_mm);
  }
}

void Trial::run(const schema::DrawRange& block, schema::UnitRecord& unit) {
  displace(block);
  const std::vector<solver::Screened>& screened = batch_->screen(block_);
  chosen_.clear();
  for (int sheet = 0; sheet < block_.sheets; ++sheet) {
    const solver::Screened& seen = screened[sheet];
    if (seen.fault == solver::Fault::none || is_sampled(block.lo + sheet)) {
      chosen_.push_back(sheet);
    } else {
      ++unit.rejected;
      ++unit.screened[{static_cast<int>(seen.fault), seen.sample}];
    }
  }
  judge_chosen();
  accepted_.clear();
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const std::uint64_t draw = block.lo + static_cast<std::uint64_t>(chosen_[k]);
    const solver::Verdict& verdict = verdicts_[k];
    if (is_sampled(draw)) unit.fault_sample.push_back({draw, verdict});
    if (verdict.first_fault == solver::Fault::undecided) {
      unit.undecided.push_back({draw, verdict});
    } else if (accepts(verdict)) {
      accepted_.push_back(chosen_[k]);
    } else {
      ++unit.rejected;
      ++unit.screened[{static_cast<int>(verdict.first_fault), verdict.fault_sample()}];
    }
  }
  add_candidates(block.lo, unit);
}

// The few paths that the lanes lose are followed by dense matrices.
void Trial::judge_chosen() {
  verdicts_ = batch_->judge(block_, chosen_);
  solver::FlatVertices vertices_mm;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    if (verdicts_[k].first_fault != solver::Fault::undecided) continue;
    family_.displace(block_.of(chosen_[k]), vertices_mm);
    verdicts_[k] = reference_.judge(vertices_mm);
  }
}

void Trial::add_candidates(std::uint64_t first_draw, schema::UnitRecord& unit) {
  solver::FlatVertices vertices_mm;
  for (auto next = accepted_.begin(); next != accepted_.end();) {
    const auto some = next + std::min<std::ptrdiff_t>(kHistoriesAtOnce, accepted_.end() - next);
    chosen_.assign(next, some);
    next = some;
    const std::vector<solver::FoldingHistory>& histories = batch_->record(block_, chosen_);
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      const std::uint64_t draw = first_draw + static_cast<std::uint64_t>(chosen_[k]);
      family_.displace(block_.of(chosen_[k]), vertices_mm);
      const auto metrics =
          solver::measure(family_.base(), vertices_mm, histories[k], campaign_.sample_deg);
      unit.candidates.push_back({draw, metrics, shifts_mm(draw)});
      ++unit.accepted;
    }
  }
}

const std::vector<solver::Verdict>& Trial::judge(const schema::DrawRange& block) {
  displace(block);
  chosen_.clear();
  for (int sheet = 0; sheet < block_.sheets; ++sheet) chosen_.push_back(sheet);
  judge_chosen();
  return verdicts_;
}

solver::FoldingHistory Trial::history(std::uint64_t draw) {
  displace({draw, draw + 1});
  return std::move(batch_->record(block_, {0}).front());
}

Eigen::Matrix2Xd Trial::shifts_mm(std::uint64_t draw) const {
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, family_.mechanism().vertices);
  draw_shifts(campaign_.misalignment, campaign_.seed, draw, shifts_mm);
  return shifts_mm;
}

bool Trial::accepts(const solver::Verdict& verdict) const {
  return verdict.first_fault != solver::Fault::undecided &&
         verdict.deploys_from_sample >= campaign_.threshold_sample();
}

std::string golden_verdicts() {
  Trial trial(
      schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                             {"accept", {{"deploys_from_deg", 180}}}},
                            "the golden campaign"));
  std::string whole_numbers;
  for (const solver::Verdict& verdict : trial.judge({0, 32})) {
    whole_numbers += std::to_string(verdict.deploys_from_sample) +
                     solver::fault_name(verdict.first_fault) + std::to_string(verdict.where) + " ";
  }
  return schema::hex(schema::hash_of(whole_numbers));
}

UnitWork::UnitWork(Trial& trial, const schema::DrawRange& range)
    : trial_(trial), range_(range), next_(range.lo) {}

void UnitWork::run_next_block() {
  constexpr double kShort_s = 0.03, kLong_s = 0.1;
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t draws = std::min(block_draws_, range_.hi - next_);
  trial_.run({next_, next_ + draws}, record_);
  next_ += draws;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  record_.seconds += seconds;
  if (seconds < kShort_s) block_draws_ = std::min(2 * block_draws_, trial_.largest_block());
  if (seconds > kLong_s) block_draws_ = std::max<std::uint64_t>(block_draws_ / 2, 1);
}

schema::UnitRecord UnitWork::take() {
  record_.range = {range_.lo, next_};
  return std::move(record_);
}

}  // namespace misalign::search
