#include "tests/simulation/invented_draws.hpp"

#include <cmath>
#include <memory>

#include "schema/catalogue/certificate_row.hpp"
#include "schema/files/hash.hpp"
#include "search/draws/golden_verdicts.hpp"
#include "search/sheets/whole_program.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/records/metrics.hpp"
#include "tests/simulation/disk.hpp"

// The linker puts the first of each pair in place of the second (--wrap in CMakeLists.txt).
namespace misalign::solver {
std::unique_ptr<Batch> batch_here(InstructionSet set, const Model& model) asm(
    "__wrap__ZN8misalign6solver10make_batchENS0_14InstructionSetERKNS0_5ModelE");
std::unique_ptr<Batch> real_batch(InstructionSet set, const Model& model) asm(
    "__real__ZN8misalign6solver10make_batchENS0_14InstructionSetERKNS0_5ModelE");
Metrics
metrics_here(const Model& model, const FlatVertices& vertices_mm, const PathRecord& record) asm(
    "__wrap__ZN8misalign6solver7measureERKNS0_5ModelERKN5Eigen6MatrixIdLi2ELin1ELi0ELi2ELin1EEE"
    "RKNS0_10PathRecordE");
Metrics
real_metrics(const Model& model, const FlatVertices& vertices_mm, const PathRecord& record) asm(
    "__real__ZN8misalign6solver7measureERKNS0_5ModelERKN5Eigen6MatrixIdLi2ELin1ELi0ELi2ELin1EEE"
    "RKNS0_10PathRecordE");
// No facet loses convexity here, and that need not be found out in every life.
double amplitude_here(const CreasePattern& sheet, const std::vector<int>& shifted) asm(
    "__wrap__ZN8misalign6solver25largest_safe_amplitude_mmERKNS0_"
    "13CreasePatternERKSt6vectorIiSaIiEE");
double amplitude_here(const CreasePattern&, const std::vector<int>&) { return 10; }
}  // namespace misalign::solver

namespace misalign::search {
std::unique_ptr<DrawAscent>
ascent_here(const schema::Campaign& campaign, const solver::Model& model, schema::Candidate start) asm(
    "__wrap__ZN8misalign6search14optimised_drawERKNS_6schema8CampaignERKNS_6solver5ModelENS1_"
    "9CandidateE");
std::unique_ptr<DrawAscent>
real_ascent(const schema::Campaign& campaign, const solver::Model& model, schema::Candidate start) asm(
    "__real__ZN8misalign6search14optimised_drawERKNS_6schema8CampaignERKNS_6solver5ModelENS1_"
    "9CandidateE");
// Builds are alike here, and need not be compared.
std::string verdicts_here(solver::InstructionSet set) asm(
    "__wrap__ZN8misalign6search15golden_verdictsB5cxx11ENS_6solver14InstructionSetE");
std::string
mark_here(const schema::Campaign& campaign, const std::string& golden_verdicts, const Parts& parts) asm(
    "__wrap__ZN8misalign6search11fingerprintERKNS_6schema8CampaignERKNSt7__cxx1112basic_stringIc"
    "St11char_traitsIcESaIcEEERKNS0_5PartsE");
std::string verdicts_here(solver::InstructionSet) { return "golden"; }
std::string mark_here(const schema::Campaign&, const std::string& golden_verdicts, const Parts&) {
  return golden_verdicts;
}
}  // namespace misalign::search

namespace misalign::simulation {
namespace {

Tempo tempo;

// Uniform numbers from the bits of a sheet.
class Dice {
 public:
  Dice(std::span<const double> numbers, std::uint64_t purpose)
      : state_(XXH3_64bits_withSeed(numbers.data(), numbers.size_bytes(), purpose)) {}
  std::uint64_t next() {  // splitmix64
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  double share() { return (static_cast<double>(next() >> 11) + 0.5) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

void take_time(std::size_t sheets, double seconds_each) {
  if (!is_running()) return;
  compute(static_cast<Nanoseconds>(static_cast<double>(sheets) * seconds_each * 1e9) + 1000);
}

class InventedBatch final : public solver::Batch {
 public:
  explicit InventedBatch(const solver::Model& model) : model_(model) {}

  // Most that do not deploy are rejected by a test.
  const std::vector<solver::Rejection>& reject(const solver::ShiftBlock& block) override {
    rejections_.assign(static_cast<std::size_t>(block.sheets), {});
    for (std::size_t k = 0; k < rejections_.size(); ++k) {
      const solver::Verdict verdict = verdict_of(block, k);
      const bool is_rejected = verdict.first_fault == solver::Fault::not_monotone &&
                               verdict.deploys_from_sample < model_.threshold_sample() &&
                               Dice(sheet(block, k), 2).share() < 0.9;
      if (is_rejected) rejections_[k] = {verdict.first_fault, verdict.fault_sample()};
    }
    if (is_running()) state_here()->draws_made += rejections_.size();
    take_time(rejections_.size(), tempo.path_s / 50);
    return rejections_;
  }
  const std::vector<solver::Verdict>& judge(const solver::ShiftBlock& block) override {
    verdicts_.clear();
    for (std::size_t k = 0; k < static_cast<std::size_t>(block.sheets); ++k) {
      verdicts_.push_back(verdict_of(block, k));
    }
    take_time(verdicts_.size(), tempo.path_s);
    return verdicts_;
  }
  const std::vector<solver::PathRecord>& measure(const solver::ShiftBlock& block) override {
    records_.clear();
    for (const solver::Verdict& verdict : judge(block)) records_.emplace_back().verdict = verdict;
    return records_;
  }
  std::vector<solver::FoldingHistory>& record(const solver::ShiftBlock& block) override {
    return real().record(block);
  }
  std::vector<solver::FoldingHistory>& record_lengths(const solver::ShiftBlock& block) override {
    return real().record_lengths(block);
  }
  double tables_deg() const override { return 0; }
  solver::Effort rejection_effort() const override { return {}; }
  solver::Effort path_effort() const override { return {}; }

 private:
  static std::span<const double> sheet(const solver::ShiftBlock& block, std::size_t k) {
    const std::size_t size = block.shifts_mm.size() / static_cast<std::size_t>(block.sheets);
    return {block.shifts_mm.data() + k * size, size};
  }
  solver::Verdict verdict_of(const solver::ShiftBlock& block, std::size_t k) const {
    return invented_verdict(sheet(block, k), static_cast<int>(model_.mechanism().diagonals.size()));
  }

  // Histories are not invented; few are asked for.
  solver::Batch& real() {
    if (!real_) real_ = solver::real_batch(solver::InstructionSet::baseline, model_);
    return *real_;
  }

  const solver::Model& model_;
  std::unique_ptr<solver::Batch> real_;
  std::vector<solver::Rejection> rejections_;
  std::vector<solver::Verdict> verdicts_;
  std::vector<solver::PathRecord> records_;
};

solver::Metrics invented_metrics(const solver::Model& model, std::span<const double> vertices_mm,
                                 int deploys_from_sample) {
  Dice dice(vertices_mm, 3);
  solver::Metrics m{};
  m.deploys_from_sample = m.energy_deploys_from_sample = deploys_from_sample;
  m.deploys_from_deg = m.energy_deploys_from_deg = deploys_from_sample * model.sample_deg();
  m.fold_limit_deg = 180;
  for (std::size_t k = 0; k < model.mechanism().diagonals.size(); ++k) {
    m.elongation.push_back((dice.share() - 0.5) * 0.1);
    m.elongation.back() > 0 ? ++m.increasing : ++m.decreasing;
  }
  const auto [least, most] = std::ranges::minmax(m.elongation);
  m.elongation_min = least;
  m.elongation_max = most;
  m.stroke_min = 1e-4;
  m.stroke_max = 0.05;
  m.slope_min_mm_per_deg = dice.share() * 1e-3;
  m.miscut_margin_mm = dice.share() * 0.03;
  m.stretch_sq_mm2 = 20 + 100 * dice.share();
  m.singular_value_min = 1e-4;
  m.shifted_vertices = static_cast<int>(model.shifted().size());
  return m;
}

// An ascent of some steps, at the end of which a shift has changed.
class InventedAscent final : public search::DrawAscent {
 public:
  InventedAscent(const solver::Model& model, schema::Candidate start)
      : model_(model),
        dice_(numbers_of(start), 4),
        steps_(1 + dice_.next() % 6),
        kept_(std::move(start)) {}
  bool finished() const override { return done_ == steps_; }
  void advance() override {
    ++done_;
    take_time(1, 5 * tempo.path_s);
  }
  schema::Candidate take() override {
    const double start_value = dice_.share();
    const int vertex = model_.shifted()[dice_.next() % model_.shifted().size()];
    kept_.shifts_mm(0, vertex) = 0.4 * (2 * dice_.share() - 1);
    kept_.metrics = invented_metrics(model_, numbers_of(kept_), tempo.samples);
    kept_.ascent = schema::AscentRecord{start_value,
                                        start_value + dice_.share(),
                                        static_cast<int>(steps_),
                                        static_cast<int>(3 * steps_),
                                        "no_step_is_better",
                                        std::nullopt};
    return std::move(kept_);
  }

 private:
  static std::span<const double> numbers_of(const schema::Candidate& sheet) {
    return {sheet.shifts_mm.data(), static_cast<std::size_t>(sheet.shifts_mm.size())};
  }
  const solver::Model& model_;
  Dice dice_;
  std::uint64_t steps_, done_ = 0;
  schema::Candidate kept_;
};

search::CertifyDraw certifier_here(const schema::Campaign& campaign, const solver::Model& model) {
  if (tempo.is_real) return search::draw_certifier(campaign, model);
  return [&](std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm, double deploys_from_deg) {
    take_time(1, 10 * tempo.path_s);
    solver::Certificate certificate;
    certificate.asked_deg = deploys_from_deg;
    certificate.end = solver::CertificateEnd::to_the_end;
    const auto intervals = static_cast<int>(10 + draw % 40);
    for (int k = 1; k <= intervals; ++k) {
      certificate.intervals.push_back({deploys_from_deg * (k - 1) / intervals,
                                       deploys_from_deg * k / intervals, false, 1e-3,
                                       solver::flat_state<double>(model.mechanism())});
    }
    return schema::certificate_row(campaign.pattern, model.mechanism(), draw, shifts_mm,
                                   certificate, tempo.path_s);
  };
}

}  // namespace

void set_tempo(const Tempo& its_tempo) { tempo = its_tempo; }

solver::Verdict invented_verdict(std::span<const double> shifts_mm, int diagonals) {
  Dice dice(shifts_mm, 1);
  const double depth = -tempo.mean_samples * std::log(dice.share());
  solver::Verdict verdict;
  verdict.deploys_from_sample = static_cast<int>(std::min<double>(depth, tempo.samples));
  verdict.score = solver::kScoresPerSample * verdict.deploys_from_sample;
  if (verdict.deploys_from_sample == tempo.samples) return verdict;
  verdict.score += static_cast<int>(dice.next() % solver::kScoresPerSample);
  const bool is_undecided = dice.share() < tempo.undecided;
  verdict.first_fault = is_undecided ? solver::Fault::undecided : solver::Fault::not_monotone;
  verdict.where = static_cast<int>(dice.next() % static_cast<std::uint64_t>(diagonals));
  if (is_undecided) verdict.path_end = solver::PathEnd::stalled;
  return verdict;
}

search::Parts invented_parts() {
  search::Parts parts = search::kWholeProgram;
  parts.certifier = certifier_here;
  return parts;
}

}  // namespace misalign::simulation

namespace misalign {

std::unique_ptr<solver::Batch> solver::batch_here(InstructionSet set, const Model& model) {
  if (simulation::tempo.is_real) return real_batch(set, model);
  return std::make_unique<simulation::InventedBatch>(model);
}

std::unique_ptr<search::DrawAscent> search::ascent_here(const schema::Campaign& campaign,
                                                        const solver::Model& model,
                                                        schema::Candidate start) {
  if (simulation::tempo.is_real) return real_ascent(campaign, model, std::move(start));
  return std::make_unique<simulation::InventedAscent>(model, std::move(start));
}

solver::Metrics solver::metrics_here(const Model& model, const FlatVertices& vertices_mm,
                                     const PathRecord& record) {
  if (simulation::tempo.is_real) return real_metrics(model, vertices_mm, record);
  return simulation::invented_metrics(
      model, {vertices_mm.data(), static_cast<std::size_t>(vertices_mm.size())},
      record.verdict.deploys_from_sample);
}

}  // namespace misalign
