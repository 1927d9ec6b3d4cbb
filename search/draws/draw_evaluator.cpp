#include "search/draws/draw_evaluator.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <optional>

#include "search/draws/draw.hpp"
#include "search/draws/models.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {
namespace {

Eigen::Matrix2Xd per_vertex(const solver::Model& model, const double* shifts_mm) {
  Eigen::Matrix2Xd columns_mm = Eigen::Matrix2Xd::Zero(2, model.mechanism().vertices);
  for (const int vertex : model.shifted()) {
    columns_mm.col(vertex) << shifts_mm[0], shifts_mm[1];
    shifts_mm += 2;
  }
  return columns_mm;
}

// Number of records measured together: many to keep the lanes busy, few enough for memory.
std::size_t records_at_once(const solver::Model& model) {
  constexpr std::size_t kBytes = 12 << 20, kFewest = 32, kMost = 256;
  // Lengths at every sample, in vectors that grow to up to twice that: 46 kB on 6 x 6.
  const std::size_t lengths = model.mechanism().diagonals.size() * model.path().stations.size();
  const std::size_t bytes = sizeof(solver::PathRecord) + 2 * sizeof(double) * lengths;
  return std::clamp(kBytes / bytes, kFewest, kMost);
}

// Measures paths; `each` gets the place of a sheet in the block, and its record.
template <class Each>
void for_each_record(const solver::Model& model, solver::Batch& batch,
                     const solver::ShiftBlock& shifts, const Each& each) {
  solver::ShiftBlock some;
  const auto all = static_cast<std::size_t>(shifts.sheets);
  const std::size_t at_once = records_at_once(model);
  for (std::size_t first = 0; first < all; first += at_once) {
    const std::size_t last = std::min(first + at_once, all);
    const std::size_t per_sheet = shifts.shifts_mm.size() / all;
    const double* const numbers = shifts.of(static_cast<int>(first));
    some.shifts_mm.assign(numbers, numbers + (last - first) * per_sheet);
    some.sheets = static_cast<int>(last - first);
    const std::vector<solver::PathRecord>& records = batch.measure(some);
    for (std::size_t k = first; k < last; ++k) each(k, records[k - first]);
  }
}

schema::Candidate candidate_of(const solver::Model& model, std::uint64_t draw,
                               const double* shifts_mm, const solver::PathRecord& record) {
  solver::FlatVertices vertices_mm;
  model.displace(shifts_mm, vertices_mm);
  return {draw, solver::measure(model, vertices_mm, record), per_vertex(model, shifts_mm)};
}

}  // namespace

std::vector<schema::Candidate> measured(const solver::Model& model, solver::Batch& batch,
                                        const solver::ShiftBlock& shifts) {
  std::vector<schema::Candidate> candidates;
  for_each_record(model, batch, shifts, [&](std::size_t k, const solver::PathRecord& record) {
    const double* const shifts_mm = shifts.of(static_cast<int>(k));
    candidates.push_back(candidate_of(model, k, shifts_mm, record));
  });
  return candidates;
}

void Draws::clear() {
  numbers.clear();
  shifts.shifts_mm.clear();
  shifts.sheets = 0;
}

void Draws::add(std::uint64_t number, std::span<const double> shifts_mm) {
  numbers.push_back(number);
  shifts.shifts_mm.insert(shifts.shifts_mm.end(), shifts_mm.begin(), shifts_mm.end());
  ++shifts.sheets;
}

void Draws::add(const Draws& others, std::size_t k) { add(others.numbers[k], others.shifts_mm(k)); }

std::span<const double> Draws::shifts_mm(std::size_t k) const {
  return {shifts.of(static_cast<int>(k)), shifts.shifts_mm.size() / size()};
}

DrawEvaluator::DrawEvaluator(schema::Campaign campaign, solver::InstructionSet set,
                             const Parts& parts)
    : campaign_(std::move(campaign)),
      model_(model_of(campaign_)),
      batch_(solver::make_batch(set, model_)),
      certify_(campaign_.certify && parts.certifier ? parts.certifier(campaign_, model_) : nullptr),
      ascend_(campaign_.search.has_ends() ? parts.ascend : nullptr) {}

std::optional<Ascents> DrawEvaluator::ascents() const {
  if (!ascend_) return std::nullopt;
  return Ascents(ascend_, campaign_, model_);
}

std::size_t DrawEvaluator::bytes_of_candidate() const {
  const auto shifts = 2 * static_cast<std::size_t>(model_.mechanism().vertices);
  return sizeof(schema::Candidate) + sizeof(schema::DrawVerdict) +
         sizeof(double) * (shifts + model_.mechanism().diagonals.size() + 2) +
         (certify_ ? sizeof(schema::CertificateRecord) + schema::kUsualCertificate_bytes : 0) +
         (ascend_ ? kUsualAscent_bytes : 0);
}

void DrawEvaluator::evaluate(const schema::DrawRange& range, schema::UnitRecord& unit,
                             const schema::FaultSampleRule& sampled,
                             const PathsAreDue& paths_are_due) {
  // Draw -> displaced pattern.
  make(range);
  // Rejected for certain, or waiting for the full path.
  const std::vector<solver::Rejection>& seen = batch_->reject(drawn_.shifts);
  unit.tables_deg = batch_->tables_deg();
  for (std::size_t k = 0; k < drawn_.size(); ++k) {
    if (seen[k].fault == solver::Fault::none || sampled.holds(drawn_.numbers[k])) {
      waiting_.add(drawn_, k);
    } else {
      unit.reject(seen[k].fault, seen[k].sample);
    }
  }
  if (waiting_.size() == 0 || !paths_are_due(waiting_.size())) return;
  // Path -> diagonals -> verdict of the fault sample, most of which the tests reject ...
  for (std::size_t k = 0; k < waiting_.size(); ++k) {
    if (sampled.holds(waiting_.numbers[k])) sampled_.add(waiting_, k);
  }
  const std::vector<solver::Verdict>& verdicts = batch_->judge(sampled_.shifts);
  std::size_t next = 0;
  for (std::size_t k = 0; k < waiting_.size(); ++k) {
    const std::uint64_t draw = waiting_.numbers[k];
    if (!sampled.holds(draw)) {
      to_measure_.add(waiting_, k);
      continue;
    }
    const solver::Verdict& verdict = verdicts[next++];
    unit.fault_sample.push_back({draw, verdict});
    if (campaign_.accepts(verdict)) {
      to_measure_.add(waiting_, k);
    } else {
      unit.turn_down(draw, verdict);
    }
  }
  waiting_.clear();
  sampled_.clear();
  // ... and of the others, with -> metrics -> unit.
  record(unit);
}

void DrawEvaluator::make(const schema::DrawRange& range) {
  const std::size_t per_sheet = 2 * model_.shifted().size();
  drawn_.numbers.resize(range.size());
  drawn_.shifts.sheets = static_cast<int>(range.size());
  drawn_.shifts.shifts_mm.resize(per_sheet * range.size());
  std::iota(drawn_.numbers.begin(), drawn_.numbers.end(), range.lo);
  draw_shifts(campaign_.misalignment, campaign_.seed, range.lo, range.size(),
              drawn_.shifts.shifts_mm.data());
}

void DrawEvaluator::add_starts(schema::UnitRecord& unit) {
  make(unit.range);
  for (std::size_t k = 0; k < drawn_.size(); ++k) {
    unit.candidates.push_back(
        {drawn_.numbers[k], {}, per_vertex(model_, drawn_.shifts_mm(k).data())});
    ++unit.accepted;
  }
}

void DrawEvaluator::certify(schema::Candidate& candidate) const {
  if (!certify_) return;
  candidate.certificate =
      certify_(candidate.draw, candidate.shifts_mm, candidate.metrics.deploys_from_deg);
}

// Records draws that no test rejects; most are accepted.
void DrawEvaluator::record(schema::UnitRecord& unit) {
  const auto keep = [&](std::size_t k, const solver::PathRecord& record) {
    if (!campaign_.accepts(record.verdict)) {
      unit.turn_down(to_measure_.numbers[k], record.verdict);
      return;
    }
    const std::uint64_t draw = to_measure_.numbers[k];
    unit.candidates.push_back(candidate_of(model_, draw, to_measure_.shifts_mm(k).data(), record));
    if (!ascend_) certify(unit.candidates.back());
    ++unit.accepted;
  };
  for_each_record(model_, *batch_, to_measure_.shifts, keep);
  to_measure_.clear();
}

const std::vector<solver::Verdict>& DrawEvaluator::judge(const schema::DrawRange& block) {
  make(block);
  return batch_->judge(drawn_.shifts);
}

Eigen::Matrix2Xd DrawEvaluator::shifts_mm(std::uint64_t draw) const {
  return shifts_of_draw(campaign_, draw);
}

UnitWork::UnitWork(DrawEvaluator& evaluator, const schema::DrawRange& range,
                   const schema::FaultSampleRule& sampled, std::size_t most_bytes)
    : evaluator_(evaluator),
      range_(range),
      sampled_(sampled),
      most_bytes_(most_bytes),
      next_(range.lo),
      block_size_(evaluator.largest_block()),
      seconds_per_path_(std::numeric_limits<double>::infinity()),
      ascents_(evaluator.ascents()) {
  record_.range = {range.lo, range.lo};
  assert(ascents_ || !evaluator.campaign().search.has_ends());
}

bool UnitWork::is_full() const {
  const std::size_t candidates = record_.candidates.size() + evaluator_.waiting();
  const std::size_t verdicts = record_.undecided.size() + record_.fault_sample.size();
  return candidates * evaluator_.bytes_of_candidate() + verdicts * sizeof(schema::DrawVerdict) >=
         most_bytes_;
}

void UnitWork::run_next_block() {
  const Stopwatch watch;
  if (ascents_ && ascents_->under_way()) {
    advance_ascents();
  } else {
    begin_block();
  }
  record_.seconds += watch.seconds();
  block_s_ += watch.seconds();
  if (ascents_ && ascents_->under_way()) return;
  block_size_.took(block_s_);
  block_s_ = 0;
}

void UnitWork::begin_block() {
  constexpr double kPaths_s = 0.08;
  const schema::DrawRange block{next_, next_ + std::min(block_size_.now(), range_.hi - next_)};
  next_ = block.hi;
  if (ascents_) {
    schema::UnitRecord starts;
    starts.range = block;
    if (evaluator_.campaign().search.shape) {
      evaluator_.add_starts(starts);
    } else {
      evaluate(block, starts, [](std::size_t) { return true; });
    }
    ascents_->begin(std::move(starts), sampled_);
    return advance_ascents();
  }
  record_.range.hi = block.hi;
  evaluate(block, record_, [&](std::size_t waiting) {
    return finished() || static_cast<double>(waiting) * seconds_per_path_ > kPaths_s;
  });
}

void UnitWork::advance_ascents() {
  ascents_->advance([&](schema::Candidate& kept) { evaluator_.certify(kept); });
  if (ascents_->finished()) record_.add(ascents_->take());
}

// Evaluates a block, and times a full path if some are followed.
void UnitWork::evaluate(const schema::DrawRange& block, schema::UnitRecord& into,
                        const DrawEvaluator::PathsAreDue& paths_are_due) {
  std::optional<Stopwatch> watch;
  std::size_t paths = 0;
  evaluator_.evaluate(block, into, sampled_, [&](std::size_t waiting) {
    if (!paths_are_due(waiting)) return false;
    paths = waiting;
    watch.emplace();
    return true;
  });
  if (watch) seconds_per_path_ = watch->seconds() / static_cast<double>(paths);
}

schema::UnitRecord UnitWork::take() {
  const Stopwatch watch;
  evaluate({next_, next_}, record_, [](std::size_t) { return true; });
  record_.seconds += watch.seconds();
  return std::move(record_);
}

namespace {

schema::UnitRecord worked_off(UnitWork work) {
  while (!work.finished()) work.run_next_block();
  return work.take();
}

}  // namespace

schema::UnitRecord work_off(DrawEvaluator& evaluator, const schema::DrawRange& range) {
  return worked_off(UnitWork(evaluator, range));
}

schema::UnitRecord judge_again(DrawEvaluator& evaluator, std::uint64_t draw) {
  const schema::FaultSampleRule densest(1);
  return worked_off(UnitWork(evaluator, {draw, draw + 1}, densest));
}

}  // namespace misalign::search
