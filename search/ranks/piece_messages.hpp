// Packs the messages of a splitting search between ranks; catalogues store packed results too.
#pragma once

#include <optional>

#include "search/ranks/wire.hpp"
#include "search/splitting/piece.hpp"

namespace misalign::search {

/// A worker's result of its piece.
struct SentPiece {
  PieceResult result;
  bool was_stopped = false;  ///< true if a signal stopped it before the piece's end
};

/// Names the layout of a packed result: a stored one is usable if its layout is the same.
std::string piece_layout();

Bytes pack(const PieceOrder& order);
PieceOrder unpack_order(const Bytes& bytes);
Bytes pack(const SentPiece& sent);
SentPiece unpack_piece(const Bytes& bytes);

/// Unpacks a result from a file, which may hold anything; nothing unless it is a possible piece of
/// this campaign. Its values may still be wrong.
std::optional<PieceResult> unpack_kept(const std::string& bytes, const schema::Campaign& campaign,
                                       const ShiftCode& code, const solver::Mechanism& mechanism);

}  // namespace misalign::search
