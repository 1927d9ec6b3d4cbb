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

/// Designs from which the numbers are sought.
enum class ChoiceStarts {
  springs,  ///< those with their best preload by linear bending, and the design
  design    ///< the design alone: an earlier choice for the same sheet
};

/// Changes one number or switch at a time, and keeps what raises the score: a pattern search (Hooke
/// & Jeeves 1961) in logarithms, by factors from 2 down to a tenth. It ends at a score of
/// kMostReserve, or with `most_cards`. UserError where no design that was tried has a card.
NumberChoice choose_numbers(const CardSheet& on, const schema::Free& free, int most_cards,
                            ChoiceStarts starts = ChoiceStarts::springs);

/// The chosen values in words: "thickness_mm 2.2, preload_n 3, hold_flat".
std::string chosen_words(const schema::Design& design, const schema::Free& free);

}  // namespace misalign::search
