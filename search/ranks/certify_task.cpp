#include "search/ranks/certify_task.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "search/ranks/departure.hpp"

namespace misalign::search {
namespace {

CertifyResult certify_sheet(RowCertifier& certifier, const CertifyOrder& order) {
  const MayBeLeft computing;
  if (order.stored) return {{}, certifier.check(order.shifts_mm, *order.stored)};
  return {certifier.certify(order.draw, order.shifts_mm, order.asked_deg), {}};
}

}  // namespace

void CertifyWork::run_next_block() {
  const Stopwatch watch;
  sent_.results.push_back(certify_sheet(certifier_, orders_[sent_.results.size()]));
  sent_.seconds += watch.seconds();
}

CertifyTask::CertifyTask(RowCertifier& certifier, CertifyList sheets, int ranks)
    : certifier_(certifier),
      sheets_(std::move(sheets)),
      open_(sheets_.count),
      workers_(static_cast<std::size_t>(ranks)) {
  std::iota(open_.begin(), open_.end(), std::size_t{0});
}

// Sheets for about a quarter of a second, and fewer towards the end, so that all workers end
// together.
std::size_t CertifyTask::job_size(const Worker& worker) const {
  constexpr double kJob_s = 0.25, kMostSheets = 64;
  if (worker.seconds_each <= 0) return 1;
  const double sheets = std::clamp(kJob_s / worker.seconds_each, 1.0, kMostSheets);
  const std::size_t share = open_.size() / (2 * workers_.size()) + 1;
  return std::min(static_cast<std::size_t>(sheets), share);
}

std::optional<Bytes> CertifyTask::assign(int worker) {
  Worker& w = workers_[worker];
  std::vector<CertifyOrder> orders;
  for (std::size_t size = job_size(w); size > 0 && !open_.empty(); --size) {
    w.sheets.push_back(open_.front());
    open_.pop_front();
    orders.push_back(sheets_.order_of(w.sheets.back()));
  }
  given_out_ += w.sheets.size();
  return orders.empty() ? std::nullopt : std::optional(pack(orders));
}

bool CertifyTask::take_back(int worker, const Bytes& result) {
  Worker& w = workers_[worker];
  SentResults sent = unpack_results(result);
  const std::size_t results = std::min(sent.results.size(), w.sheets.size());
  if (results > 0) w.seconds_each = sent.seconds / static_cast<double>(results);
  for (std::size_t k = 0; k < results; ++k) {
    waiting_.push_back({w.sheets[k], std::move(sent.results[k])});
  }
  done_ += results;
  given_out_ -= w.sheets.size();
  open_.insert(open_.begin(), w.sheets.begin() + static_cast<std::ptrdiff_t>(results),
               w.sheets.end());
  w.sheets.clear();
  return sent.was_stopped;
}

bool CertifyTask::compute_one_block() {
  if (open_.empty()) return false;
  const std::size_t sheet = open_.front();
  open_.pop_front();
  waiting_.push_back({sheet, certify_sheet(certifier_, sheets_.order_of(sheet))});
  ++done_;
  return true;
}

void CertifyTask::commit() {
  constexpr double kApart_s = 1;
  if (!committed_s_ || watch_.seconds() - *committed_s_ >= kApart_s) commit_all();
}

void CertifyTask::commit_all() {
  if (waiting_.empty()) return;
  sheets_.keep(std::exchange(waiting_, {}));
  committed_s_ = watch_.seconds();
}

ProgressCounts CertifyTask::counts() const {
  ProgressCounts counts;
  counts.standing.draws = counts.draws_of_run = done_;
  counts.draws_left = sheets_.count - done_;
  counts.limited = true;
  counts.of = "certificates";
  return counts;
}

}  // namespace misalign::search
