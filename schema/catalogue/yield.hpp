// The yields that `misalign tolerance` has counted, stored in a catalogue.
#pragma once

#include <vector>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// Of the miscut copies of a candidate, how many still deploy from an angle.
struct Yield {
  std::uint64_t draw;
  double amplitude_mm;  ///< errors are uniform on [-amplitude, amplitude], of every vertex
  std::uint64_t trials, survivors;
  std::uint64_t undecided;              ///< of the trials: the interval allows for both
  std::optional<double> from_deg = {};  ///< none: the campaign's threshold

  /// Whether the parts are no more than the whole, and none is negative as SQLite keeps it.
  bool adds_up() const {
    const std::uint64_t kMost = std::uint64_t{1} << 62;
    return trials > 0 && trials < kMost && survivors < kMost && undecided < kMost &&
           survivors + undecided <= trials;
  }

  friend bool operator==(const Yield&, const Yield&) = default;
};

/// Share of the decided trials, and its interval: {"amplitude_mm", "trials", "survivors",
/// "undecided", "share", "share_low", "share_high"}, and "from_deg" where it is not the threshold.
Json yield_json(const Yield& yield);
/// A list of them.
Json yields_json(const std::vector<Yield>& yields);

/// Within its caller's transaction. Of two of one draw, amplitude and angle that with more trials
/// is kept; of draws that are no candidates nothing is, and these are returned. Throws
/// SQLite::Exception.
std::vector<std::uint64_t> write_yields(SQLite::Database& database,
                                        const std::vector<Yield>& yields,
                                        const std::string& commit);

/// The yields of one candidate, by amplitude and angle. UserError (bad_input) if one of them does
/// not add up: SQLite looks at no CHECK while it reads.
std::vector<Yield> read_yields(SQLite::Database& database, std::uint64_t draw);

/// Takes over those of another catalogue whose candidates are in this one, of a splitting search
/// under whatever number, as write_yields does. UserError (bad_input) if `from` cannot be read, or
/// holds rows that no catalogue may.
void copy_yields(SQLite::Database& from, SQLite::Database& into);
/// The same within one catalogue: from one candidate to another that is the same sheet.
void hand_on_yields(SQLite::Database& database, std::uint64_t from, std::uint64_t to);

/// Every yield: its draw is a candidate, its counts add up, and its share and interval are theirs.
/// Throws SQLite::Exception.
std::vector<Finding> check_yields(SQLite::Database& database);

}  // namespace misalign::schema
