#include "search/trial.hpp"

#include <chrono>

#include "search/draw.hpp"

namespace misalign::search {

Trial::Trial(schema::Campaign campaign)
    : campaign_(std::move(campaign)),
      mechanism_(solver::build_mechanism(campaign_.pattern.base.sheet, campaign_.pattern.base.holes,
                                         campaign_.pattern.base.folding)),
      plan_(solver::plan_path(mechanism_, campaign_.pattern.base.folding,
                              campaign_.pattern.base.sheet.vertices_mm, campaign_.path())),
      reference_(mechanism_, plan_),
      shifts_mm_(Eigen::Matrix2Xd::Zero(2, campaign_.pattern.base.sheet.vertex_count())) {}

void Trial::displace(std::uint64_t draw) {
  draw_shifts(campaign_.misalignment, campaign_.seed, draw, shifts_mm_);
  vertices_mm_ = campaign_.pattern.base.sheet.vertices_mm + shifts_mm_;
}

Outcome Trial::run(std::uint64_t draw) {
  displace(draw);
  const solver::Verdict verdict = reference_.judge(vertices_mm_);
  if (!accepts(verdict)) return {verdict, std::nullopt};
  const solver::PerforatedSheet& base = campaign_.pattern.base;
  const auto history = solver::record_history(base, mechanism_, plan_, vertices_mm_);
  const auto metrics = solver::measure(base, vertices_mm_, history, campaign_.sample_deg);
  return {verdict, schema::Candidate{draw, metrics, shifts_mm_}};
}

solver::FoldingHistory Trial::history(std::uint64_t draw) {
  displace(draw);
  return solver::record_history(campaign_.pattern.base, mechanism_, plan_, vertices_mm_);
}

bool Trial::accepts(const solver::Verdict& verdict) const {
  return verdict.first_fault != solver::Fault::undecided &&
         verdict.deploys_from_sample >= campaign_.threshold_sample();
}

std::string golden_verdicts() {
  constexpr std::uint64_t kDraws = 32;
  Trial trial(
      schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                             {"accept", {{"deploys_from_deg", 180}}}},
                            "the golden campaign"));
  std::string whole_numbers;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const solver::Verdict verdict = trial.run(draw).verdict;
    whole_numbers += std::to_string(verdict.deploys_from_sample) +
                     solver::fault_name(verdict.first_fault) + std::to_string(verdict.where) + " ";
  }
  return schema::hex(schema::hash_of(whole_numbers));
}

UnitWork::UnitWork(Trial& trial, const schema::DrawRange& range)
    : trial_(trial), range_(range), next_(range.lo) {}

void UnitWork::run_next_draw() {
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t draw = next_++;
  Outcome outcome = trial_.run(draw);
  const solver::Verdict& verdict = outcome.verdict;
  if (draw % schema::kFaultSampleEvery == 0) record_.fault_sample.push_back({draw, verdict});
  if (outcome.candidate) {
    ++record_.accepted;
    record_.candidates.push_back(std::move(*outcome.candidate));
  } else if (verdict.first_fault == solver::Fault::undecided) {
    record_.undecided.push_back({draw, verdict});
  } else {
    ++record_.rejected;
    ++record_.screened[{static_cast<int>(verdict.first_fault), verdict.fault_sample()}];
  }
  record_.seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

schema::UnitRecord UnitWork::take() {
  record_.range = {range_.lo, next_};
  return std::move(record_);
}

}  // namespace misalign::search
