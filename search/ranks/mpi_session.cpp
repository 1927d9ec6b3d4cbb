#include "search/ranks/mpi_session.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <thread>
#include <utility>

#include "search/ranks/stop_signal.hpp"

namespace misalign::search {
namespace {

constexpr int kResultTag = 1, kJobTag = 2, kBeatTag = 3;

}  // namespace

struct MpiSession::Beats {
  MPI_Comm comm;
};

MpiSession::MpiSession(Alone alone) : has_begun_(alone == Alone::with_mpi || launched_by_mpi()) {
  if (!has_begun_) return;
  int threads = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_MULTIPLE, &threads);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  // Beats need threads in MPI; without them MPI alone notices a cut link, after minutes.
  if (threads < MPI_THREAD_MULTIPLE) return;
  beats_ = std::make_unique<Beats>();
  MPI_Comm_dup(MPI_COMM_WORLD, &beats_->comm);
}

MpiSession::~MpiSession() {
  if (!has_begun_) return;
  if (beats_) MPI_Comm_free(&beats_->comm);
  MPI_Finalize();
}

int MpiSession::broadcast(int value) const {
  if (ranks_ == 1) return value;
  MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return value;
}

std::string MpiSession::broadcast(const std::string& text) const {
  if (ranks_ == 1) return text;
  std::string result = text;
  result.resize(static_cast<std::size_t>(broadcast(message_length(text.size()))));
  MPI_Bcast(result.data(), static_cast<int>(result.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
  return result;
}

std::vector<std::string> MpiSession::gather(const std::string& text) const {
  if (ranks_ == 1) return {text};
  int size = message_length(text.size());
  std::vector<int> sizes(ranks_), starts(ranks_);
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::exclusive_scan(sizes.begin(), sizes.end(), starts.begin(), 0);
  std::string all(static_cast<std::size_t>(starts.back() + sizes.back()), ' ');
  MPI_Gatherv(text.data(), size, MPI_CHAR, all.data(), sizes.data(), starts.data(), MPI_CHAR, 0,
              MPI_COMM_WORLD);
  std::vector<std::string> texts;
  for (int k = 0; rank_ == 0 && k < ranks_; ++k) {
    texts.push_back(
        all.substr(static_cast<std::size_t>(starts[k]), static_cast<std::size_t>(sizes[k])));
  }
  return texts;
}

bool MpiSession::meet(double patience_s) const {
  if (ranks_ == 1) return true;
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  Backoff backoff;
  for (int met = 0; MPI_Test(&request, &met, MPI_STATUS_IGNORE), !met;) {
    if (seconds_since_leave() > patience_s) return false;
    backoff.wait();
  }
  return true;
}

void MpiSession::send_result(const Bytes& result) const {
  MPI_Send(result.data(), message_length(result.size()), MPI_BYTE, 0, kResultTag, MPI_COMM_WORLD);
}

namespace {

// Receives a message that has arrived.
Bytes received(int from, int tag, const MPI_Status& status) {
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Bytes bytes(static_cast<std::size_t>(size));
  MPI_Recv(bytes.data(), size, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return bytes;
}

}  // namespace

std::optional<MpiSession::Arrived> MpiSession::receive_result() const {
  if (ranks_ == 1) return std::nullopt;
  int arrived = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kResultTag, MPI_COMM_WORLD, &arrived, &status);
  if (!arrived) return std::nullopt;
  const int from = status.MPI_SOURCE;
  return Arrived{from, received(from, kResultTag, status)};
}

void MpiSession::send_job(int to, const Bytes& job) const {
  MPI_Send(job.data(), message_length(job.size()), MPI_BYTE, to, kJobTag, MPI_COMM_WORLD);
}

bool MpiSession::job_waiting() const {
  int arrived = 0;
  MPI_Iprobe(0, kJobTag, MPI_COMM_WORLD, &arrived, MPI_STATUS_IGNORE);
  return arrived != 0;
}

Bytes MpiSession::receive_job() const {
  Backoff backoff;
  while (!job_waiting()) backoff.wait();
  MPI_Status status;
  MPI_Probe(0, kJobTag, MPI_COMM_WORLD, &status);
  return received(0, kJobTag, status);
}

void MpiSession::send_beat(int to) const {
  MPI_Request request;
  MPI_Isend(nullptr, 0, MPI_BYTE, to, kBeatTag, beats_->comm, &request);
  MPI_Request_free(&request);
}

std::optional<int> MpiSession::receive_beat() const {
  int arrived = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kBeatTag, beats_->comm, &arrived, &status);
  if (!arrived) return std::nullopt;
  MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, kBeatTag, beats_->comm, MPI_STATUS_IGNORE);
  return status.MPI_SOURCE;
}

void MpiSession::abort(int exit_code) const {
  if (has_begun_) MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

void Backoff::wait() {
  std::this_thread::sleep_for(std::chrono::microseconds(microseconds_));
  microseconds_ = std::min(1000, microseconds_ + 50);
}

namespace {

const char* launched_rank_text() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}) {
    if (const char* rank = std::getenv(name)) return rank;
  }
  return nullptr;
}

}  // namespace

int launched_rank() {
  const char* const rank = launched_rank_text();
  return rank ? std::atoi(rank) : 0;
}

bool launched_by_mpi() { return launched_rank_text() != nullptr; }

// Tries the innermost launcher first. In a batch script SLURM_NTASKS is the allocation, but
// SLURM_STEP_NUM_TASKS counts tasks that srun has started; Flux removes all of these from its
// scripts.
std::optional<LaunchedTasks> launched_tasks() {
  for (const auto& [variable, launcher] : {std::pair{"OMPI_COMM_WORLD_SIZE", "mpirun"},
                                           {"FLUX_JOB_SIZE", "flux"},
                                           {"PMI_SIZE", "the launcher"},
                                           {"SLURM_STEP_NUM_TASKS", "srun"}}) {
    if (const char* count = std::getenv(variable)) return {{launcher, variable, std::atoi(count)}};
  }
  return std::nullopt;
}

}  // namespace misalign::search
