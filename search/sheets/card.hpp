// The card of one sheet: its design's requirements beside the results of studies.
#pragma once

#include <array>
#include <vector>

#include "search/sheets/card_lines.hpp"
#include "search/sheets/studies.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::search {

struct CardOptions {
  std::uint64_t trials = 1000;  ///< miscut copies, and settlings of loose joints
  int jobs = 1;
  Advice advice = Advice::with;
};

/// Groups of lines in their order, each with studies of its own.
enum class CardPart { path, energy, contact, drive, filling, copies };
inline constexpr std::size_t kCardParts = 6;
using CardParts = std::array<std::vector<schema::CardLine>, kCardParts>;

struct StudiedCard {
  schema::Card card;
  CardParts parts;
};

/// The lines of one part.
std::vector<schema::CardLine> card_lines(CardPart part, const CardSheet& on,
                                         const CardOptions& options);
/// The design's filling from the card's angle of use, with the fewest springs that suffice.
solver::Actuation filling_in_use(const CardSheet& on);

/// The card of a sheet; `same` are lines that another card of the sheet has made: a part without
/// lines is studied. UserError: 3 where the sheet does not deploy, 1 where its path is lost.
StudiedCard card_of(const CardSheet& on, const CardOptions& options, CardParts same = {});
StudiedCard card_of(const Subject& subject, const CardOptions& options);

/// A sheet with its model's design. UserError (bad_input) where it does not deploy.
CardSheet card_sheet(const Subject& subject);

}  // namespace misalign::search
