// Reads wishes: a pattern file whose "design" says what a sheet must do, and whose "free" says what
// may be chosen for it.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// A number of the design that is chosen between two bounds, or from a list.
struct FreeNumber {
  const DesignNumber* row;
  std::vector<double> values;  ///< ascending: the two bounds, or the list
  bool is_range;

  double least() const { return values.front(); }
  double most() const { return values.back(); }
  /// Returns the allowed value nearest to this one, by ratio.
  double nearest(double value) const;
};

/// Free shifts, choices and numbers. Absent keys are not free: a sheet keeps its shifts, a design
/// its values.
struct Free {
  std::vector<FreeNumber> numbers = {};  ///< all but the angle of use
  std::vector<double> from_deg = {};     ///< angles of use to try, descending; empty: the design's
  std::optional<std::array<double, 2>> amplitude_mm = {};  ///< largest shift of a vertex in x or y
  std::vector<Json> holes = {};  ///< values of the pattern's "holes"; empty: the pattern's
  std::vector<Json> fills = {};  ///< values of the design's "fill"; empty: the design's
  bool rim = false;              ///< vertices of the rim may be shifted, too
  bool hold_flat = false;        ///< a stop, latch or frame may hold the sheet flat
  bool one_a_hole = false;       ///< each hole may have one spring
};

struct Wish {
  Json document;                    ///< the pattern file, without "free"
  std::string text;                 ///< the whole file's JSON, which names the request
  std::string source;               ///< its name in sentences
  std::filesystem::path directory;  ///< files that it names are relative to this
  Free free;
};

/// Reads the "free" of a pattern file. UserError (bad_input) with every fault: keys that are no
/// numbers of a design or requirements of it, bounds out of order or beyond the design's.
Wish read_wish(const std::string& path);

/// One of each of the choices; null or none: the file's own.
struct WishChoice {
  const Json *holes = nullptr, *fill = nullptr;
  std::optional<double> from_deg = {};

  /// ", checkerboard-even, springs, for 120°"; empty where nothing is chosen.
  std::string words() const;
};
/// All combinations of choices: of each the angles of use, descending.
std::vector<WishChoice> choices_of(const Free& free);
/// Returns the document with these choices.
Json wished_document(const Wish& wish, const WishChoice& choice);

}  // namespace misalign::schema
