// Chooses the free numbers of a sheet's design, so that its card has the largest reserve.
#pragma once

#include "schema/pattern/wish.hpp"
#include "search/designs/card_score.hpp"
#include "search/sheets/card.hpp"

namespace misalign::search {

struct NumberChoice {
  schema::Design design;
  CardScore score;  ///< score of all requirements but those of copies
  CardParts parts;  ///< the card's; that of copies is empty
  int cards = 0;    ///< number of cards that were made
};

struct NumberChoiceOptions {
  int most_cards = 40;
  double first_factor = 2;     ///< factor of a number's first change
  double least_factor = 1.05;  ///< the search ends where no change by less is better
};

/// Changes one number or switch at a time, from springs with their best preload by linear bending
/// and from the design's own values, and keeps what raises the score: a pattern search (Hooke &
/// Jeeves 1961) in logarithms. It ends at a score of kMostReserve, or with its options. UserError
/// where no design that was tried has a card.
NumberChoice choose_numbers(const CardSheet& on, const schema::Free& free,
                            const NumberChoiceOptions& options);

/// The chosen values in words: "thickness_mm 2.2, preload_n 3, hold_flat".
std::string chosen_words(const schema::Design& design, const schema::Free& free);

}  // namespace misalign::search
