// The messages of a splitting search between ranks, as bytes; results are kept in catalogues too.
#pragma once

#include <optional>

#include "search/ranks/wire.hpp"
#include "search/splitting/piece.hpp"

namespace misalign::search {

/// What a worker sends back of its piece.
struct SentPiece {
  PieceResult result;
  bool was_stopped = false;  ///< by a signal, before the piece was done
};

/// How a packed result is laid out: those that are kept are of use where this is the same.
std::string piece_layout();

Bytes pack(const PieceOrder& order);
PieceOrder unpack_order(const Bytes& bytes);
Bytes pack(const SentPiece& sent);
SentPiece unpack_piece(const Bytes& bytes);

/// A result that was kept in a file, which may say anything; nothing if it is none of a piece of
/// this campaign's sheets. What it says of them may still be wrong.
std::optional<PieceResult> unpack_kept(const std::string& bytes, const schema::Campaign& campaign,
                                       const ShiftCode& code, const solver::Mechanism& mechanism);

}  // namespace misalign::search
