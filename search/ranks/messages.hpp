// The messages between ranks, as bytes. All ranks run the same program on the same kind of machine.
#pragma once

#include <limits>
#include <string>

#include "schema/records/unit_record.hpp"
#include "search/ranks/wire.hpp"

namespace misalign::search {

/// What a worker sends back of its range.
struct SentUnit {
  schema::UnitRecord unit;
  bool was_stopped = false;  ///< by a signal, before the range was done
};

/// What a worker is to do.
Bytes pack(const schema::DrawRange& range);
schema::DrawRange unpack_range(const Bytes& bytes);

/// Which metrics a packed candidate holds, in their order, and how large its parts are.
std::string candidate_layout();
/// The same of a packed unit: ranks of two builds understand each other where this is the same.
std::string message_layout();

Bytes pack(const SentUnit& sent);
SentUnit unpack_unit(const Bytes& bytes);

/// The length of a message as MPI counts it. UserError (failure) where that is more than `most`,
/// which units are kept far below (see UnitWork::is_full).
int message_length(std::size_t bytes, std::size_t most = std::numeric_limits<int>::max());

}  // namespace misalign::search
