#include "schema/catalogue/population_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/since.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::schema {
namespace {

// Takes the rows of candidates away that `statement` selects, with their yields.
void drop(SQLite::Database& database, SQLite::Statement statement) {
  struct Row {
    std::int64_t draw, unit;
    int sample;
    std::string sheet;
  };
  std::vector<Row> rows;
  while (statement.executeStep()) {
    rows.push_back({statement.getColumn(0).getInt64(), statement.getColumn(1).getInt64(),
                    statement.getColumn(2).getInt(), statement.getColumn(3).getString()});
  }
  statement.reset();
  SQLite::Statement part(database, "SELECT digest_part FROM unit WHERE lo = ?");
  SQLite::Statement update(database,
                           "UPDATE unit SET accepted = accepted - 1, rejected = rejected + 1, "
                           "digest_part = ? WHERE lo = ?");
  SQLite::Statement yields(database, "DELETE FROM yield WHERE draw = ?");
  SQLite::Statement sheet(database, "DELETE FROM sheet WHERE draw = ?");
  SQLite::Statement candidate(database, "DELETE FROM candidate WHERE draw = ?");
  for (const Row& row : rows) {
    part.reset();
    part.bind(1, row.unit);
    if (!part.executeStep() || part.getColumn(0).getBytes() != 16) continue;  // a damaged file
    CandidateSum sum =
        CandidateSum::from_bytes(static_cast<const unsigned char*>(part.getColumn(0).getBlob()));
    CandidateSum one;
    one.add(static_cast<std::uint64_t>(row.draw), row.sample, row.sheet);
    sum.subtract(one);
    update.reset();
    const auto bytes = sum.bytes();
    update.bind(1, bytes.data(), static_cast<int>(bytes.size()));
    update.bind(2, row.unit);
    update.exec();
    for (SQLite::Statement* remove : {&yields, &sheet, &candidate}) {
      remove->reset();
      remove->bind(1, row.draw);
      remove->exec();
    }
  }
}

}  // namespace

double share_reaching(std::uint32_t level, const std::vector<LevelCount>& levels) {
  double share = 1;
  for (std::uint32_t k = 0; k < level; ++k) {
    if (k >= levels.size()) return 0;
    share *= static_cast<double>(levels[k].survivors) / levels[k].particles;
  }
  return share;
}

std::vector<int> read_levels(SQLite::Database& database) {
  return reading(database, [&] {
    std::vector<int> scores;
    if (version_of(database) < kSplittingSince) return scores;
    SQLite::Statement rows(database, "SELECT score FROM level ORDER BY number");
    while (rows.executeStep()) scores.push_back(rows.getColumn(0).getInt());
    return scores;
  });
}

void write_levels(SQLite::Database& database, const std::vector<int>& scores, double sample_deg) {
  SQLite::Statement insert(database,
                           "INSERT INTO level (number, score, deploys_from_deg) VALUES (?,?,?)");
  for (std::size_t k = 0; k < scores.size(); ++k) {
    insert.reset();
    insert.bind(1, stored(k + 1));
    insert.bind(2, scores[k]);
    insert.bind(3, scores[k] * sample_deg / solver::kScoresPerSample);
    insert.exec();
  }
}

std::vector<LevelCount> read_population(SQLite::Database& database, std::uint64_t unit) {
  std::vector<LevelCount> levels;
  SQLite::Statement rows(database,
                         "SELECT level, particles, survivors, ancestors, tried, taken, undecided, "
                         "met, seconds FROM population WHERE unit = ? ORDER BY level");
  rows.bind(1, stored(unit));
  while (rows.executeStep()) {
    const auto count = [&](int column) { return rows.getColumn(column).getUInt(); };
    levels.push_back({count(0), std::max(count(1), 1u), count(2), count(3),
                      draw_of(rows.getColumn(4)), draw_of(rows.getColumn(5)),
                      draw_of(rows.getColumn(6)), draw_of(rows.getColumn(7)),
                      rows.getColumn(8).getDouble()});
  }
  return levels;
}

std::vector<PieceRow> read_pieces(SQLite::Database& database, const std::string& layout) {
  std::vector<PieceRow> pieces;
  SQLite::Statement rows(database,
                         "SELECT population, level, lo, hi, result FROM piece WHERE layout = ? "
                         "ORDER BY population, level, lo");
  rows.bind(1, layout);
  while (rows.executeStep()) {
    const auto number = [&](int column) { return rows.getColumn(column).getUInt(); };
    pieces.push_back(
        {number(0), number(1), number(2), number(3), layout, rows.getColumn(4).getString()});
  }
  return pieces;
}

void write_pieces(SQLite::Database& database, const std::vector<PieceRow>& pieces) {
  // Another build's result is replaced.
  SQLite::Statement insert(database,
                           "INSERT OR REPLACE INTO piece (population, level, lo, hi, layout, "
                           "result) VALUES (?,?,?,?,?,?)");
  for (const PieceRow& piece : pieces) {
    insert.reset();
    insert.bind(1, piece.population);
    insert.bind(2, piece.level);
    insert.bind(3, piece.lo);
    insert.bind(4, piece.hi);
    insert.bind(5, piece.layout);
    insert.bind(6, piece.result.data(), static_cast<int>(piece.result.size()));
    insert.exec();
  }
}

void drop_pieces(SQLite::Database& database, std::uint32_t population) {
  SQLite::Statement remove(database, "DELETE FROM piece WHERE population = ?");
  remove.bind(1, population);
  remove.exec();
}

std::string sheet_hash(const std::string& displacements_mm) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash_of(displacements_mm));
  return {reinterpret_cast<const char*>(bytes.digest), sizeof bytes.digest};
}

CandidateSum sum_of_levels(std::uint64_t unit, const std::vector<LevelCount>& levels) {
  CandidateSum sum;
  for (const LevelCount& level : levels) {
    sum.add_text(fmt::format("unit {} level {}: {} of {}", unit, level.level, level.survivors,
                             level.particles));
  }
  return sum;
}

void keep_each_sheet_once(SQLite::Database& database, const DrawRange& added,
                          const std::optional<std::uint64_t>& most) {
  SQLite::Statement again(
      database,
      "SELECT DISTINCT more.draw, unit, deploys_from_sample, more.hash FROM sheet AS one "
      "JOIN sheet AS least ON least.hash = one.hash "
      "JOIN sheet AS more ON more.hash = one.hash AND more.draw > least.draw "
      "JOIN candidate ON candidate.draw = more.draw WHERE one.draw >= ? AND one.draw < ?");
  again.bind(1, stored(added.lo));
  again.bind(2, stored(added.hi));
  drop(database, std::move(again));
  if (!most) return;
  SQLite::Statement beyond(
      database,
      "SELECT draw, unit, deploys_from_sample, hash FROM candidate JOIN sheet USING (draw) "
      "ORDER BY draw LIMIT -1 OFFSET ?");
  beyond.bind(1, stored(*most));
  drop(database, std::move(beyond));
}

}  // namespace misalign::schema
