// Names the filling of a sheet's holes in sentences and tables.
#pragma once

#include <string>

#include "solver/fill/fill.hpp"

namespace misalign::schema {

/// Nouns of a filling: "springs" and "spring"; "springs" in a column's name, of seven letters.
struct FillNouns {
  const char *parts, *part, *column;
};
FillNouns fill_nouns(const solver::Fill& fill);

/// Units of angles in texts and in HTML.
inline constexpr const char *kDegreeWord = " deg", *kDegreeSign = "°";

/// "springs of 50 N/mm", or "rubber plates of 1 mm, shear modulus 0.5 MPa"; "empty holes";
/// "springs, each with its rate and free length" if all diagonals of the sheet, that many, have
/// their own.
std::string fill_words(const solver::Fill& fill, int diagonals);
/// State at rest: "relaxed when flat", "preloaded with 3 N when flat", "pre-stretched by 1.1 at 60
/// deg", "preloaded by free lengths of their own when flat".
std::string rest_words(const solver::Fill& fill, const char* degree);
/// The state as an adjective: "relaxed", "preloaded", "pre-stretched".
const char* state_words(const solver::Fill& fill);
/// Filling and state: "springs of 50 N/mm, relaxed when flat".
std::string filling_words(const solver::Fill& fill, int diagonals, const char* degree);

/// Returns whether the filling is springs of one rate on all diagonals, relaxed when flat apart
/// from preload, which push, too.
bool are_equal_springs(const solver::Fill& fill);

/// Throws a UserError (bad_request) about `who`, which knows springs alone, if it is none.
void need_springs(const solver::Fill& fill, const std::string& who);
/// Throws one, too, if springs differ, are not on all diagonals, or do not push.
void need_plain_springs(const solver::Fill& fill, const std::string& who);
/// The same, but they may be on one diagonal of each hole alone.
void need_like_springs(const solver::Fill& fill, const std::string& who);

}  // namespace misalign::schema
