// Pieces of populations under way that a file keeps, and that lie: they are made again.
#include <sys/resource.h>

#include <cstring>

#include "schema/catalogue/ledger_check.hpp"
#include "search/ranks/piece_messages.hpp"
#include "tests/search/hostile_ladder.hpp"

namespace misalign::search {
namespace {

class HostilePieces : public HostileLadder {};

// A row of the table that is no use costs nothing but the work: the end is the same.
TEST_F(HostilePieces, PiecesThatAreNoneAreMadeAgain) {
  const std::string kSet = "UPDATE piece SET ";
  for (const char* lie :
       {"result = substr(result, 1, length(result) / 2)", "result = substr(result, 1, 57)",
        "result = x''", "result = x'00'", "result = CAST(result || x'00' AS BLOB)",
        "result = CAST(result || zeroblob(1000000) AS BLOB)", "result = zeroblob(1000000)",
        // How many survivors it has to list.
        "result = CAST(substr(result, 1, 49) || x'0000000000000010' || substr(result, 58) AS BLOB)",
        "result = CAST(substr(result, 1, 49) || x'ffffffffffffffff' || substr(result, 58) AS BLOB)",
        "population = 1", "population = 7", "population = (1 << 33) + 2", "population = -1",
        "population = 4294967295", "level = level + 5", "level = -1 WHERE level = 0", "lo = 1",
        "lo = -1", "hi = 19", "hi = lo", "hi = 1 << 40", "layout = 'another'", "layout = ''"}) {
    SCOPED_TRACE(lie);
    const std::string path = attacked(kSet + lie);
    EXPECT_EQ(refused([&] { climb(path, 3); }), "");
    EXPECT_EQ(digest_of(path), digest_);
    EXPECT_TRUE(schema::check_ledger(*schema::open_for_reading(path), campaign_).empty());
  }
}

// A disk that gives one bit wrongly, wherever: in a score, a shift, a count.
TEST_F(HostilePieces, AFlippedBitIsSeen) {
  const std::string path = attacked("SELECT 1");
  {
    SQLite::Database database(path, SQLite::OPEN_READWRITE);
    const std::vector<schema::PieceRow> pieces = schema::read_pieces(database, piece_layout());
    ASSERT_EQ(pieces.size(), 2u);
    SQLite::Statement read(database, "SELECT result FROM piece WHERE level = ?"),
        write(database, "UPDATE piece SET result = ? WHERE level = ?");
    for (const schema::PieceRow& row : pieces) {
      EXPECT_NE(schema::read_result(database, row), "");
      read.tryReset();
      read.bind(1, row.level);
      ASSERT_TRUE(read.executeStep());
      const std::string good = read.getColumn(0).getString();
      read.reset();
      const std::size_t apart = good.size() / 100 + 1;
      for (std::size_t byte = 0; byte < good.size(); byte += apart) {
        std::string bad = good;
        bad[byte] = static_cast<char>(bad[byte] ^ (1 << byte % 8));
        write.tryReset();
        write.bind(1, bad.data(), static_cast<int>(bad.size()));
        write.bind(2, row.level);
        write.exec();
        ASSERT_EQ(schema::read_result(database, row), "") << "byte " << byte;
      }
    }
  }
  EXPECT_EQ(refused([&] { climb(path, 3); }), "");
  EXPECT_EQ(digest_of(path), digest_);
}

using PieceLie = void (*)(PieceResult&);

// Such that a commit would fail, or keep what no draw can have.
const std::pair<const char*, PieceLie> kPieceLies[] = {
    {"a score", [](PieceResult& piece) { piece.there.scores[0] = -2; }},
    {"a level of a shift", [](PieceResult& piece) { piece.there.sheets.bytes[0] = 3; }},
    {"shorter sheets", [](PieceResult& piece) { piece.there.sheets.bytes.pop_back(); }},
    {"a survivor", [](PieceResult& piece) { piece.survivors.back() = piece.hi; }},
    {"a survivor twice", [](PieceResult& piece) { piece.survivors[1] = piece.survivors[0]; }},
    {"a step", [](PieceResult& piece) { piece.met[0].step = 3; }},
    {"the largest step", [](PieceResult& piece) { piece.met[0].step = 0xFFFFFFFF; }},
    {"another level's step", [](PieceResult& piece) { piece.met[0].step = piece.level == 0; }},
    {"a particle", [](PieceResult& piece) { piece.met[0].particle = piece.hi; }},
    {"two in one place",
     [](PieceResult& piece) {
       piece.met[1].step = piece.met[0].step;
       piece.met[1].particle = piece.met[0].particle;
     }},
    {"a shift", [](PieceResult& piece) { piece.met[0].candidate.shifts_mm(0, 6) = 0.1; }},
    {"no shift",
     [](PieceResult& piece) {
       piece.met[0].candidate.shifts_mm(0, 6) = std::numeric_limits<double>::quiet_NaN();
     }},
    {"a vertex more",
     [](PieceResult& piece) {
       Eigen::Matrix2Xd& shifts_mm = piece.met[0].candidate.shifts_mm;
       shifts_mm = Eigen::Matrix2Xd::Zero(2, shifts_mm.cols() + 1);
     }},
    {"a diagonal less",
     [](PieceResult& piece) { piece.met[0].candidate.metrics.elongation.pop_back(); }},
    {"an elongation",
     [](PieceResult& piece) {
       piece.met[0].candidate.metrics.elongation[0] = std::numeric_limits<double>::infinity();
     }},
    {"an angle",
     [](PieceResult& piece) {
       piece.met[0].candidate.metrics.deploys_from_deg = std::numeric_limits<double>::quiet_NaN();
     }},
    {"a sample",
     [](PieceResult& piece) { piece.met[0].candidate.metrics.deploys_from_sample = 0; }},
    {"moves", [](PieceResult& piece) { piece.tried = std::uint64_t{1} << 63; }},
    {"no moves", [](PieceResult& piece) { piece.tried = 0; }},
    {"moves taken", [](PieceResult& piece) { piece.taken = piece.tried + 1; }},
    {"undecided", [](PieceResult& piece) { piece.undecided = ~std::uint64_t{0}; }},
    {"time", [](PieceResult& piece) { piece.seconds = -1; }},
    {"no time",
     [](PieceResult& piece) { piece.seconds = std::numeric_limits<double>::quiet_NaN(); }},
};

TEST_F(HostilePieces, PiecesThatLieAreMadeAgainSlow) {
  for (const auto& [what, lie] : kPieceLies) {
    SCOPED_TRACE(what);
    const std::string path = attacked("SELECT 1");
    {
      SQLite::Database database(path, SQLite::OPEN_READWRITE);
      std::vector<schema::PieceRow> pieces = schema::read_pieces(database, piece_layout());
      ASSERT_EQ(pieces.size(), 2u);
      for (schema::PieceRow& row : pieces) {
        const std::string kept = schema::read_result(database, row);
        PieceResult result = unpack_piece({kept.begin(), kept.end()}).result;
        ASSERT_GE(result.met.size(), 2u);
        ASSERT_GE(result.survivors.size(), 2u);
        lie(result);
        const Bytes bytes = pack(SentPiece{result, false});
        row.result.assign(bytes.begin(), bytes.end());
        EXPECT_FALSE(
            unpack_kept(row.result, campaign_, climber_.moves().code(), climber_.mechanism()));
      }
      schema::write_pieces(database, pieces);
    }
    EXPECT_EQ(refused([&] { climb(path, 3); }), "");
    EXPECT_EQ(digest_of(path), digest_);
  }
}

// A list is as long as there are bytes for it, whatever it says.
TEST_F(HostilePieces, ListsTakeNoMemoryForWhatIsNotThere) {
  Bytes bytes = pack(SentPiece{});
  const std::size_t items = 4'000'000;
  std::memcpy(bytes.data() + bytes.size() - sizeof items, &items, sizeof items);
  bytes.resize(bytes.size() + items);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_FALSE(unpack_kept({bytes.begin(), bytes.end()}, campaign_, climber_.moves().code(),
                           climber_.mechanism()));
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 200'000);  // kB
}

// Particles 0 to 3 of a level, which survive with this score.
PieceResult four_survivors(std::uint32_t level, int score) {
  PieceResult result;
  result.level = level;
  result.hi = 4;
  for (std::uint32_t k = 0; k < 4; ++k) {
    result.survivors.push_back(k);
    const std::uint8_t sheet[1] = {1};
    result.there.sheets.add(sheet);
    result.there.scores.push_back(score);
  }
  return result;
}

// Below the next level nobody survives, at the last one nobody either.
TEST(RestoredPieces, SurvivorsHaveReachedTheNextLevel) {
  const Ladder ladder{kClimbSeed, {1000, 2000}, 4, 4};
  Population population(ladder, 0);
  EXPECT_FALSE(population.restore(four_survivors(0, 999)));
  EXPECT_TRUE(population.restore(four_survivors(0, 1000)));
  EXPECT_FALSE(population.restore(four_survivors(1, 1999)));
  EXPECT_TRUE(population.restore(four_survivors(1, 2000)));
  EXPECT_EQ(population.level(), 2u);
  EXPECT_FALSE(population.restore(four_survivors(2, kBeyondAll)));
  EXPECT_FALSE(population.is_done());
}

// Of a level finder nobody falls below the level that it has reached; and there are so many levels
// at most.
TEST(RestoredPieces, PilotsDoNotFall) {
  LevelFinder level_finder(kClimbSeed, 4, 4, 1000000);
  EXPECT_TRUE(level_finder.restore(four_survivors(0, 1000)));
  EXPECT_FALSE(level_finder.restore(four_survivors(1, 999)));
  EXPECT_FALSE(level_finder.restore(four_survivors(1, 0)));
  for (int level = 1; !level_finder.is_done(); ++level) {
    ASSERT_TRUE(
        level_finder.restore(four_survivors(static_cast<std::uint32_t>(level), 1000 + level)));
    ASSERT_LE(level, 256);
  }
  EXPECT_EQ(level_finder.ladder().scores.size(), 256u);
  EXPECT_EQ(level_finder.ladder().scores.back(), 1000000);
  EXPECT_FALSE(level_finder.is_whole());
}

}  // namespace
}  // namespace misalign::search
