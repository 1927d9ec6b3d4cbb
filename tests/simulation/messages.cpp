// MPI between the ranks of a machine of virtual time, in place of the library's functions of these
// names. Messages take their time: those of one rank to another arrive in order, those of different
// ranks in any order, as MPI promises. A rank waits by looking again after a while.
#define OMPI_SKIP_MPICXX 1  // of MPI's C functions alone
#include <mpi.h>

#include <algorithm>
#include <cstring>
#include <deque>
#include <map>
#include <memory>

#include "tests/simulation/machine.hpp"

namespace misalign::simulation {
namespace {

constexpr int kCollectiveTag = -7;

struct Message {
  int from, tag;
  bool is_of_world;
  std::vector<char> bytes;
  Nanoseconds arrives_at;
};

struct Mailbox {
  std::deque<Message> messages;
  std::map<int, Nanoseconds> last_from;
  int barriers = 0;  // that this rank has entered
};

Mailbox& mailbox(int rank) {
  static std::vector<Mailbox> all(static_cast<std::size_t>(ranks_here()));
  return all[static_cast<std::size_t>(rank)];
}

void send(const void* bytes, std::size_t size, int to, int tag, bool is_of_world) {
  Mailbox& box = mailbox(to);
  // Most arrive soon; some are late.
  Random& random = machine_random();
  const Nanoseconds longest = happens(random, 0.02) ? 300 * kMillisecond : kMillisecond / 2;
  Nanoseconds& last = box.last_from[rank_here()];
  last = std::max(
      last,
      now() + 1000 + static_cast<Nanoseconds>(up_to(random, static_cast<std::uint64_t>(longest))));
  const char* const first = static_cast<const char*>(bytes);
  box.messages.push_back({rank_here(), tag, is_of_world, {first, first + size}, last});
}

// The first message that has arrived: of several senders' the one that came first.
std::deque<Message>::iterator arrived(int from, int tag, bool is_of_world) {
  auto& messages = mailbox(rank_here()).messages;
  auto best = messages.end();
  for (auto at = messages.begin(); at != messages.end(); ++at) {
    const bool fits = at->tag == tag && at->is_of_world == is_of_world && at->arrives_at <= now() &&
                      (from == MPI_ANY_SOURCE || at->from == from);
    if (fits && (best == messages.end() || at->arrives_at < best->arrives_at)) best = at;
  }
  return best;
}

bool has_arrived(int from, int tag, bool is_of_world) {
  return arrived(from, tag, is_of_world) != mailbox(rank_here()).messages.end();
}

std::vector<char> wait_for(int from, int tag) {
  for (Nanoseconds look = kMillisecond; !has_arrived(from, tag, true);) {
    compute(look);
    look = std::min(2 * look, 100 * kMillisecond);
  }
  const auto at = arrived(from, tag, true);
  std::vector<char> bytes = std::move(at->bytes);
  mailbox(rank_here()).messages.erase(at);
  return bytes;
}

std::size_t size_of(int count, MPI_Datatype type) {
  return static_cast<std::size_t>(count) * (type == MPI_INT ? sizeof(int) : 1);
}

bool is_world(MPI_Comm comm) { return comm == MPI_COMM_WORLD; }

// A request is the number of the barrier that it is about.
MPI_Request request_of(int barrier) {
  return reinterpret_cast<MPI_Request>(static_cast<std::intptr_t>(barrier));
}
int barrier_of(MPI_Request request) {
  return static_cast<int>(reinterpret_cast<std::intptr_t>(request));
}

}  // namespace
}  // namespace misalign::simulation

extern "C" {
using namespace misalign::simulation;

int MPI_Init_thread(int*, char***, int, int* provided) {
  compute(static_cast<Nanoseconds>(up_to(machine_random(), 100 * kMillisecond)));
  *provided = MPI_THREAD_MULTIPLE;
  return MPI_SUCCESS;
}
int MPI_Comm_rank(MPI_Comm, int* rank) { return *rank = rank_here(), MPI_SUCCESS; }
int MPI_Comm_size(MPI_Comm, int* size) { return *size = ranks_here(), MPI_SUCCESS; }
int MPI_Comm_dup(MPI_Comm, MPI_Comm* copy) { return *copy = MPI_COMM_SELF, MPI_SUCCESS; }
int MPI_Comm_free(MPI_Comm*) { return MPI_SUCCESS; }
int MPI_Finalize() { return MPI_SUCCESS; }
int MPI_Abort(MPI_Comm, int exit_code) { end_job(exit_code); }

int MPI_Bcast(void* bytes, int count, MPI_Datatype type, int root, MPI_Comm) {
  if (rank_here() == root) {
    for (int rank = 0; rank < ranks_here(); ++rank) {
      if (rank != root) send(bytes, size_of(count, type), rank, kCollectiveTag, true);
    }
  } else {
    const std::vector<char> received = wait_for(root, kCollectiveTag);
    if (!received.empty()) std::memcpy(bytes, received.data(), received.size());
  }
  return MPI_SUCCESS;
}

int MPI_Gatherv(const void* sent, int count, MPI_Datatype type, void* received, const int*,
                const int* starts, MPI_Datatype, int root, MPI_Comm) {
  if (rank_here() != root) {
    send(sent, size_of(count, type), root, kCollectiveTag, true);
    return MPI_SUCCESS;
  }
  for (int rank = 0; rank < ranks_here(); ++rank) {
    char* const to = static_cast<char*>(received) + size_of(starts[rank], type);
    if (rank == root) {
      std::memcpy(to, sent, size_of(count, type));
      continue;
    }
    const std::vector<char> bytes = wait_for(rank, kCollectiveTag);
    if (!bytes.empty()) std::memcpy(to, bytes.data(), bytes.size());
  }
  return MPI_SUCCESS;
}

int MPI_Gather(const void* sent, int count, MPI_Datatype type, void* received, int, MPI_Datatype,
               int root, MPI_Comm comm) {
  std::vector<int> starts;
  for (int rank = 0; rank < ranks_here(); ++rank) starts.push_back(rank * count);
  return MPI_Gatherv(sent, count, type, received, nullptr, starts.data(), type, root, comm);
}

int MPI_Ibarrier(MPI_Comm, MPI_Request* request) {
  *request = request_of(++mailbox(rank_here()).barriers);
  return MPI_SUCCESS;
}

int MPI_Test(MPI_Request* request, int* is_over, MPI_Status*) {
  *is_over = 1;
  for (int rank = 0; rank < ranks_here(); ++rank) {
    if (mailbox(rank).barriers < barrier_of(*request)) *is_over = 0;
  }
  return MPI_SUCCESS;
}

int MPI_Send(const void* bytes, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  send(bytes, size_of(count, type), to, tag, is_world(comm));
  return MPI_SUCCESS;
}
int MPI_Isend(const void* bytes, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request*) {
  return MPI_Send(bytes, count, type, to, tag, comm);
}
int MPI_Request_free(MPI_Request*) { return MPI_SUCCESS; }

int MPI_Iprobe(int from, int tag, MPI_Comm comm, int* is_there, MPI_Status* status) {
  *is_there = has_arrived(from, tag, is_world(comm)) ? 1 : 0;
  if (!*is_there || status == MPI_STATUS_IGNORE) return MPI_SUCCESS;
  const auto at = arrived(from, tag, is_world(comm));
  status->MPI_SOURCE = at->from;
  status->_ucount = at->bytes.size();
  return MPI_SUCCESS;
}
int MPI_Probe(int from, int tag, MPI_Comm comm, MPI_Status* status) {
  for (int is_there = 0; MPI_Iprobe(from, tag, comm, &is_there, status), !is_there;) {
    compute(kMillisecond);
  }
  return MPI_SUCCESS;
}
int MPI_Get_count(const MPI_Status* status, MPI_Datatype, int* count) {
  *count = static_cast<int>(status->_ucount);
  return MPI_SUCCESS;
}
int MPI_Recv(void* bytes, int, MPI_Datatype, int from, int tag, MPI_Comm comm, MPI_Status*) {
  const auto at = arrived(from, tag, is_world(comm));
  if (!at->bytes.empty()) std::memcpy(bytes, at->bytes.data(), at->bytes.size());
  mailbox(rank_here()).messages.erase(at);
  return MPI_SUCCESS;
}
}
