// Packs the messages between ranks, which run the same program on the same kind of machine.
#pragma once

#include <limits>
#include <string>

#include "schema/records/unit_record.hpp"
#include "search/ranks/wire.hpp"

namespace misalign::search {

/// A worker's result of its range.
struct SentUnit {
  schema::UnitRecord unit;
  bool was_stopped = false;  ///< true if a signal stopped it before the range's end
};

/// Packs a worker's order.
Bytes pack(const schema::DrawRange& range);
schema::DrawRange unpack_range(const Bytes& bytes);

/// Names the metrics of a packed candidate in their order, and the sizes of its parts.
std::string candidate_layout();
/// Names the layout of a packed unit: ranks of two builds can work together if it is the same.
std::string message_layout();

Bytes pack(const SentUnit& sent);
SentUnit unpack_unit(const Bytes& bytes);

/// Returns the length of a message as MPI counts it. UserError (failure) above `most`; units stay
/// far below it (see UnitWork::is_full).
int message_length(std::size_t bytes, std::size_t most = std::numeric_limits<int>::max());

}  // namespace misalign::search
