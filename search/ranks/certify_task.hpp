// Makes or checks certificates: a job is some sheets, its result their certificates or findings.
#pragma once

#include <deque>
#include <functional>
#include <vector>

#include "search/ranks/certify_messages.hpp"
#include "search/ranks/rank_task.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

/// Work on some sheets, one at a time.
class CertifyWork {
 public:
  CertifyWork(RowCertifier& certifier, std::vector<CertifyOrder> orders)
      : certifier_(certifier), orders_(std::move(orders)) {}

  bool finished() const { return sent_.results.size() == orders_.size(); }
  bool is_full() const { return false; }
  void run_next_block();
  SentResults take() { return std::move(sent_); }

 private:
  RowCertifier& certifier_;
  const std::vector<CertifyOrder> orders_;
  SentResults sent_;
};

/// The sheets of a run by their numbers, from 0 on.
struct CertifyList {
  std::size_t count;
  std::function<CertifyOrder(std::size_t)> order_of;
  /// A finished sheet and its result; `keep` stores them in one transaction.
  struct Done {
    std::size_t sheet;
    CertifyResult result;
  };
  std::function<void(std::vector<Done>)> keep;
};

class CertifyTask final : public RankTask {
 public:
  /// The certifier must outlive this object.
  CertifyTask(RowCertifier& certifier, CertifyList sheets, int ranks);

  std::optional<Bytes> assign(int worker) override;
  bool has_job(int worker) const override { return !workers_[worker].sheets.empty(); }
  bool take_back(int worker, const Bytes& result) override;
  bool compute_one_block() override;
  void hand_in_own() override {}
  std::size_t rows_waiting() const override { return waiting_.size(); }
  /// Commits about once a second.
  void commit() override;
  void commit_all() override;
  bool anything_open() const override { return !open_.empty(); }
  bool complete() const override { return open_.empty() && given_out_ == 0; }
  ProgressCounts counts() const override;

 private:
  struct Worker {
    std::vector<std::size_t> sheets;  // its job
    double seconds_each = 0;          // time per sheet of its last job; 0: not known yet
  };
  std::size_t job_size(const Worker& worker) const;

  RowCertifier& certifier_;
  const CertifyList sheets_;
  std::deque<std::size_t> open_;  // ascending
  std::size_t given_out_ = 0, done_ = 0;
  std::vector<Worker> workers_;
  std::vector<CertifyList::Done> waiting_;
  Stopwatch watch_;
  std::optional<double> committed_s_;
};

}  // namespace misalign::search
