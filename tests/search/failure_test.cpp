#include "search/terminal/failure.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <functional>
#include <new>

#include "schema/files/storage.hpp"

namespace misalign::search {
namespace {

// What is said of what `work` throws.
Failure failure_in(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return failure_of(error);
  }
  return {0, "nothing was thrown"};
}

TEST(Failure, NoLibraryHasTheWordAlone) {
  using schema::Json;
  const std::pair<std::function<void()>, int> kCases[] = {
      {[] { throw std::bad_alloc(); }, 1},
      {[] { std::vector<char>().reserve(static_cast<std::size_t>(-1)); }, 1},
      {[] { Json("text").get<int>(); }, 3},
      {[] { Json(Json::object()).at("no such key"); }, 3},
      {[] { Json("\xff").dump(); }, 3},
      {[] { SQLite::Database("/no/such/place.db").exec("SELECT 1"); }, 1},
      {[] { throw SQLite::Exception("out of memory", SQLITE_NOMEM); }, 1},
      {[] { static_cast<void>(std::filesystem::file_size("/no/such\n/place")); }, 1},
      {[] { throw std::runtime_error("odd\x1b[2J"); }, 1}};
  for (const auto& [work, exit_code] : kCases) {
    const Failure failure = failure_in(work);
    SCOPED_TRACE(failure.sentence);
    EXPECT_EQ(failure.exit_code, exit_code);
    for (const char* word :
         {"bad_alloc", "json.exception", "std::", "basic_string", "\x1b", "\n"}) {
      EXPECT_EQ(failure.sentence.find(word), std::string::npos) << word;
    }
    EXPECT_NE(failure.sentence.find(" ("), std::string::npos) << "why?";
    EXPECT_NE(failure.sentence.find("; "), std::string::npos) << "what to do?";
  }
}

TEST(Failure, ASentenceForThePersonStays) {
  const Failure failure = failure_in([] { throw schema::UserError(75, "as it is"); });
  EXPECT_EQ(failure.exit_code, 75);
  EXPECT_EQ(failure.sentence, "as it is");
}

// A catalogue keeps what was committed; an output that has no name yet does not.
TEST(Failure, OfAnOutputNothingIsKept) {
  const SQLite::Exception full("database or disk is full", SQLITE_FULL);
  const std::string kept = schema::storage_failure("a.db", full).what();
  EXPECT_NE(kept.find("what was committed is good"), std::string::npos) << kept;
  const std::string digits(32, 'a');
  const std::string gone = schema::storage_failure("in/a.db." + digits + ".partial", full).what();
  EXPECT_EQ(gone.find("in/a.db: the disk is full"), 0u) << gone;
  EXPECT_NE(gone.find("nothing was written"), std::string::npos) << gone;
  EXPECT_EQ(gone.find("goes on"), std::string::npos) << gone;
  EXPECT_EQ(gone.find("partial"), std::string::npos) << gone;
  for (const std::string& other :
       {"a.db." + digits, digits + ".partial", "." + digits + ".partia"}) {
    const std::string said = schema::storage_failure(other, full).what();
    EXPECT_EQ(said.find(other + ": the disk is full"), 0u) << said;
  }
}

}  // namespace
}  // namespace misalign::search
