#include "schema/catalogue/population_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/catalogue/database.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::schema {
namespace {

// Levels' angles are stored rounded.
constexpr double kAngleRounding = 1e-12;

double angle_of(double score, double sample_deg) {
  return score * sample_deg / solver::kScoresPerSample;
}

constexpr std::size_t kHash_bytes = sizeof(XXH128_canonical_t);

std::string hash_bytes_of(const std::string& text) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash_of(text));
  return {reinterpret_cast<const char*>(bytes.digest), kHash_bytes};
}

// Returns XXH3-128 of a whole row, which is appended to its result.
std::string piece_hash(const PieceRow& piece) {
  return hash_bytes_of(fmt::format("{} {} {} {} {}\n{}", piece.population, piece.level, piece.lo,
                                   piece.hi, piece.layout, piece.result));
}

// Returns whether a row of a population can follow those before it: the table's checks, which
// SQLite evaluates only when it writes, and the order of its levels. Columns as in read_population.
bool adds_up(SQLite::Statement& row, const std::vector<LevelCount>& before) {
  const auto number = [&](int column) { return row.getColumn(column).getInt64(); };
  const std::int64_t particles = number(1), survivors = number(2), ancestors = number(3);
  const std::int64_t tried = number(4), taken = number(5), undecided = number(6);
  const std::int64_t most = std::max(kMostFirstDraws, kMostParticles);
  const std::int64_t most_ancestors = before.empty() ? survivors : before.back().ancestors;
  const double seconds = row.getColumn(8).getDouble();
  return number(0) == stored(before.size()) && (before.empty() || before.back().survivors > 0) &&
         particles > 0 && particles <= most && survivors >= 0 && survivors <= particles &&
         ancestors >= 0 && ancestors <= std::min(survivors, most_ancestors) &&
         (ancestors > 0) == (survivors > 0) && tried >= 0 && taken >= 0 && taken <= tried &&
         undecided >= 0 && undecided <= tried - taken && number(7) >= 0 && seconds >= 0 &&
         std::isfinite(seconds);
}

}  // namespace

std::vector<int> read_levels(SQLite::Database& database) {
  return reading(database, [&] {
    std::vector<int> scores;
    SQLite::Statement rows(
        database,
        "SELECT number, score, deploys_from_deg, sample_deg, round(threshold_deg / sample_deg) "
        "FROM level, (SELECT json_extract(configuration, '$.path.sample_deg') AS sample_deg, "
        "json_extract(configuration, '$.accept.deploys_from_deg') AS threshold_deg FROM campaign) "
        "ORDER BY number");
    std::int64_t last = 0;
    while (rows.executeStep()) {
      const std::int64_t number = rows.getColumn(0).getInt64(),
                         score = rows.getColumn(1).getInt64();
      const double angle_deg = rows.getColumn(2).getDouble();
      const double expected_deg =
          angle_of(static_cast<double>(score), rows.getColumn(3).getDouble());
      last = static_cast<std::int64_t>(rows.getColumn(4).getInt()) * solver::kScoresPerSample;
      const bool is_next = number == stored(scores.size() + 1) && scores.size() < kMostLevels &&
                           score > (scores.empty() ? 0 : scores.back()) && score <= last &&
                           std::abs(angle_deg - expected_deg) <= kAngleRounding * expected_deg;
      if (!is_next)
        throw damaged(database, fmt::format("level {} is none of its campaign", number));
      scores.push_back(static_cast<int>(score));
    }
    if (!scores.empty() && scores.back() != last) {
      throw damaged(database, "its last level is not its campaign's criterion");
    }
    return scores;
  });
}

void write_levels(SQLite::Database& database, const std::vector<int>& scores, double sample_deg) {
  SQLite::Statement insert(database,
                           "INSERT INTO level (number, score, deploys_from_deg) VALUES (?,?,?)");
  for (std::size_t k = 0; k < scores.size(); ++k) {
    execute(insert, k + 1, scores[k], angle_of(scores[k], sample_deg));
  }
}

std::vector<LevelCount> read_population(SQLite::Database& database, std::uint64_t unit,
                                        std::size_t most_levels) {
  std::vector<LevelCount> levels;
  SQLite::Statement rows =
      bound(database,
            "SELECT level, particles, survivors, ancestors, tried, taken, undecided, "
            "met, seconds FROM population WHERE unit = ? ORDER BY level",
            unit);
  const std::uint64_t number = unit / kNumbersOfPopulation;
  while (rows.executeStep()) {
    if (levels.size() > most_levels || !adds_up(rows, levels)) {
      throw damaged(database, fmt::format("population {} does not add up at level {}", number,
                                          rows.getColumn(0).getInt64()));
    }
    const auto count = [&](int column) { return rows.getColumn(column).getUInt(); };
    levels.push_back({count(0), count(1), count(2), count(3), draw_of(rows.getColumn(4)),
                      draw_of(rows.getColumn(5)), draw_of(rows.getColumn(6)),
                      draw_of(rows.getColumn(7)), rows.getColumn(8).getDouble()});
  }
  if (levels.empty() || levels.back().survivors > 0) {
    throw damaged(database, fmt::format("population {} has not come to its end", number));
  }
  return levels;
}

void each_population(
    SQLite::Database& database,
    const std::function<void(const DrawRange& numbers, const std::vector<LevelCount>&)>& see) {
  const std::size_t top = read_levels(database).size();
  SQLite::Statement lost(database,
                         "SELECT unit FROM population WHERE unit NOT IN (SELECT lo FROM unit)");
  if (lost.executeStep()) {
    throw damaged(database,
                  fmt::format("population {} is in no unit",
                              lost.getColumn(0).getInt64() / stored(kNumbersOfPopulation)));
  }
  SQLite::Statement units(database, "SELECT lo, hi FROM unit ORDER BY lo");
  while (units.executeStep()) {
    const DrawRange range{draw_of(units.getColumn(0)), draw_of(units.getColumn(1))};
    const std::uint64_t population = range.lo / kNumbersOfPopulation;
    if (range != numbers_of({population, population + 1})) {
      throw damaged(database, fmt::format("unit {} is no population", range.lo));
    }
    see(range, read_population(database, range.lo, top));
    if (top == 0) throw damaged(database, "it has populations without levels");
  }
}

std::vector<PieceRow> read_pieces(SQLite::Database& database, const std::string& layout) {
  std::vector<PieceRow> pieces;
  SQLite::Statement rows = bound(database,
                                 "SELECT population, level, lo, hi FROM piece WHERE layout = ? "
                                 "ORDER BY population, level, lo",
                                 layout);
  while (rows.executeStep()) {
    const auto number = [&](int column) { return rows.getColumn(column).getUInt(); };
    pieces.push_back({number(0), number(1), number(2), number(3), layout, {}});
  }
  return pieces;
}

std::string read_result(SQLite::Database& database, const PieceRow& piece) {
  SQLite::Statement row =
      bound(database, "SELECT result FROM piece WHERE population = ? AND level = ? AND lo = ?",
            piece.population, piece.level, piece.lo);
  if (!row.executeStep()) return "";
  PieceRow read = piece;
  read.result = row.getColumn(0).getString();
  const std::size_t end = read.result.size() - std::min(read.result.size(), kHash_bytes);
  const std::string hash = read.result.substr(end);
  read.result.resize(end);
  return hash == piece_hash(read) ? read.result : "";
}

void write_pieces(SQLite::Database& database, const std::vector<PieceRow>& pieces) {
  // Another build's result is replaced.
  SQLite::Statement insert(database,
                           "INSERT OR REPLACE INTO piece (population, level, lo, hi, layout, "
                           "result) VALUES (?,?,?,?,?,?)");
  for (const PieceRow& piece : pieces) {
    execute(insert, piece.population, piece.level, piece.lo, piece.hi, piece.layout,
            Blob(piece.result + piece_hash(piece)));
  }
}

void drop_pieces(SQLite::Database& database, std::uint32_t population) {
  bound(database, "DELETE FROM piece WHERE population = ?", population).exec();
}

std::string sheet_hash(const std::string& displacements_mm) {
  return hash_bytes_of(displacements_mm);
}

CandidateSum sum_of_levels(std::uint64_t unit, const std::vector<LevelCount>& levels) {
  CandidateSum sum;
  for (const LevelCount& level : levels) {
    sum.add_text(fmt::format("unit {} level {}: {} of {}", unit, level.level, level.survivors,
                             level.particles));
  }
  return sum;
}

std::optional<std::uint64_t> number_in(SQLite::Database& into, SQLite::Database& from,
                                       std::uint64_t draw) {
  SQLite::Statement theirs = prepared(from, "SELECT hash FROM sheet WHERE draw = ?");
  bind_all(theirs, draw);
  if (!reading(from, [&] { return theirs.executeStep(); })) return draw;
  SQLite::Statement ours(into,
                         "SELECT coalesce((SELECT draw FROM sheet WHERE hash = ?1 AND draw = ?2), "
                         "(SELECT min(draw) FROM sheet WHERE hash = ?1))");
  bind_all(ours, theirs.getColumn(0), draw);
  ours.executeStep();
  return ours.getColumn(0).isNull() ? std::nullopt : std::optional(draw_of(ours.getColumn(0)));
}

}  // namespace misalign::schema
