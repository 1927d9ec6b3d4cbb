// The card of one sheet: its design's requirements beside the results of studies.
#pragma once

#include "schema/exchange/card_json.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::search {

struct CardOptions {
  std::uint64_t trials = 1000;  ///< miscut copies, and settlings of loose joints
  int jobs = 1;
};

struct StudiedCard {
  schema::Card card;
  solver::Actuation springs;  ///< the design's, from the card's angle of use
};

/// UserError: 3 where the sheet does not deploy, 1 where its path is lost.
StudiedCard card_of(const Subject& subject, const CardOptions& options);

}  // namespace misalign::search
