#include "search/terminal/failure.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <functional>
#include <new>

#include "schema/files/storage.hpp"

namespace misalign::search {
namespace {

using schema::Cause;

schema::UserError failure_in(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return failure_of(error);
  }
  return {Cause::check_failed, "nothing was thrown"};
}

TEST(Failure, NoLibraryHasTheWordAlone) {
  using schema::Json;
  const std::pair<std::function<void()>, Cause> kCases[] = {
      {[] { throw std::bad_alloc(); }, Cause::failure},
      {[] { std::vector<char>().reserve(static_cast<std::size_t>(-1)); }, Cause::failure},
      {[] { Json("text").get<int>(); }, Cause::bad_input},
      {[] { Json(Json::object()).at("no such key"); }, Cause::bad_input},
      {[] { Json("\xff").dump(); }, Cause::bad_input},
      {[] { SQLite::Database("/no/such/place.db").exec("SELECT 1"); }, Cause::failure},
      {[] { throw SQLite::Exception("out of memory", SQLITE_NOMEM); }, Cause::failure},
      {[] { static_cast<void>(std::filesystem::file_size("/no/such\n/place")); }, Cause::failure},
      {[] { throw std::runtime_error("odd\x1b[2J"); }, Cause::failure}};
  for (const auto& [work, cause] : kCases) {
    const schema::UserError failure = failure_in(work);
    const std::string sentence = failure.what();
    SCOPED_TRACE(sentence);
    EXPECT_EQ(failure.cause(), cause);
    for (const char* word :
         {"bad_alloc", "json.exception", "std::", "basic_string", "\x1b", "\n"}) {
      EXPECT_EQ(sentence.find(word), std::string::npos) << word;
    }
    EXPECT_NE(sentence.find(" ("), std::string::npos) << "why?";
    EXPECT_NE(sentence.find("; "), std::string::npos) << "what to do?";
  }
}

TEST(Failure, ASentenceForThePersonStays) {
  const schema::UserError failure =
      failure_in([] { throw schema::UserError(Cause::foreign, "as it is"); });
  EXPECT_EQ(failure.cause(), Cause::foreign);
  EXPECT_STREQ(failure.what(), "as it is");
}

// SQLite says so where a program stands still while it changes a log's index.
TEST(Failure, AnotherProgramThatStandsStillKeepsItLocked) {
  const SQLite::Exception still("locking protocol", SQLITE_PROTOCOL);
  EXPECT_EQ(schema::storage_failure("a.db", still).cause(), Cause::in_use);
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
