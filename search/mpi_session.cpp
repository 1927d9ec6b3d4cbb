#include "search/mpi_session.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace misalign::search {
namespace {

constexpr int kUnitTag = 1, kRangeTag = 2;

}  // namespace

MpiSession::MpiSession() {
  MPI_Init(nullptr, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
}

MpiSession::~MpiSession() { MPI_Finalize(); }

int MpiSession::broadcast(int value) const {
  MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return value;
}

std::string MpiSession::broadcast(const std::string& text) const {
  std::string result = text;
  result.resize(static_cast<std::size_t>(broadcast(static_cast<int>(text.size()))));
  MPI_Bcast(result.data(), static_cast<int>(result.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
  return result;
}

void MpiSession::send_unit(const schema::UnitRecord& unit) const {
  const Bytes bytes = pack(unit);
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, 0, kUnitTag, MPI_COMM_WORLD);
}

std::optional<MpiSession::Arrival> MpiSession::receive_unit() const {
  int arrived = 0, size = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kUnitTag, MPI_COMM_WORLD, &arrived, &status);
  if (!arrived) return std::nullopt;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Bytes bytes(static_cast<std::size_t>(size));
  MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, kUnitTag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return Arrival{status.MPI_SOURCE, unpack_unit(bytes)};
}

void MpiSession::send_range(int to, const schema::DrawRange& range) const {
  const std::uint64_t ends[2] = {range.lo, range.hi};
  MPI_Send(ends, 2, MPI_UINT64_T, to, kRangeTag, MPI_COMM_WORLD);
}

bool MpiSession::range_waiting() const {
  int arrived = 0;
  MPI_Iprobe(0, kRangeTag, MPI_COMM_WORLD, &arrived, MPI_STATUS_IGNORE);
  return arrived != 0;
}

schema::DrawRange MpiSession::receive_range() const {
  Backoff backoff;
  while (!range_waiting()) backoff.wait();
  std::uint64_t ends[2];
  MPI_Recv(ends, 2, MPI_UINT64_T, 0, kRangeTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return {ends[0], ends[1]};
}

void MpiSession::abort(int exit_code) const {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

void Backoff::wait() {
  std::this_thread::sleep_for(std::chrono::microseconds(microseconds_));
  microseconds_ = std::min(1000, microseconds_ + 50);
}

int launched_rank() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}) {
    if (const char* rank = std::getenv(name)) return std::atoi(rank);
  }
  return 0;
}

}  // namespace misalign::search
