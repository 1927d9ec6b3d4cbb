// Stores yields of `misalign tolerance` in a catalogue.
#pragma once

#include <vector>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// Number of miscut copies of a candidate that still deploy from an angle.
struct Yield {
  std::uint64_t draw;
  double amplitude_mm;  ///< cutting errors are uniform on [-amplitude, amplitude] in x and y of
                        ///< every vertex
  std::uint64_t trials, survivors;
  std::uint64_t undecided;              ///< undecided trials; the interval allows for both verdicts
  std::optional<double> from_deg = {};  ///< none: the campaign's threshold

  /// Returns whether the parts do not exceed the whole, and none is negative as stored by SQLite.
  bool adds_up() const {
    const std::uint64_t kMost = std::uint64_t{1} << 62;
    return trials > 0 && trials < kMost && survivors < kMost && undecided < kMost &&
           survivors + undecided <= trials;
  }

  friend bool operator==(const Yield&, const Yield&) = default;
};

/// Returns the share of the decided trials and its interval: {"amplitude_mm", "trials",
/// "survivors", "undecided", "share", "share_low", "share_high"}, and "from_deg" if it is not the
/// threshold.
Json yield_json(const Yield& yield);
/// Returns a list of yields.
Json yields_json(const std::vector<Yield>& yields);

/// Writes yields within the caller's transaction. Of two yields of one draw, amplitude and angle
/// that with more trials is kept. Returns the draws that are no candidates, whose yields are not
/// stored. Throws SQLite::Exception.
std::vector<std::uint64_t> write_yields(SQLite::Database& database,
                                        const std::vector<Yield>& yields,
                                        const std::string& commit);

/// Reads the yields of one candidate, by amplitude and angle. UserError (bad_input) if one does not
/// add up: SQLite evaluates no CHECK while it reads.
std::vector<Yield> read_yields(SQLite::Database& database, std::uint64_t draw);

/// Copies yields of another catalogue for candidates that are in this one, of a splitting search
/// under any number, like write_yields. UserError (bad_input) if `from` cannot be read, or holds
/// rows that no catalogue may.
void copy_yields(SQLite::Database& from, SQLite::Database& into);
/// Copies yields within one catalogue, from one candidate to another of the same sheet.
void hand_on_yields(SQLite::Database& database, std::uint64_t from, std::uint64_t to);

/// Checks every yield: its draw is a candidate, its counts add up, and its share and interval
/// follow from them. Throws SQLite::Exception.
std::vector<Finding> check_yields(SQLite::Database& database);

}  // namespace misalign::schema
