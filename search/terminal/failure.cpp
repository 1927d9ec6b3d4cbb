#include "search/terminal/failure.hpp"

#include <filesystem>
#include <new>
#include <stdexcept>

#include "schema/files/storage.hpp"

namespace misalign::search {
namespace {

// A library's message on one line, without "[json.exception.type_error.302] ".
std::string words_of(const std::exception& error) {
  std::string words = error.what();
  if (words.starts_with('[')) words.erase(0, std::min(words.find("] ") + 2, words.size()));
  return schema::shortened(schema::printable(words), 300);
}

}  // namespace

schema::UserError failure_of(const std::exception& error) {
  using schema::Cause;
  if (const auto* user = dynamic_cast<const schema::UserError*>(&error)) return *user;
  if (dynamic_cast<const std::bad_alloc*>(&error) ||
      dynamic_cast<const std::length_error*>(&error)) {
    return {Cause::failure,
            "memory has run out (the machine has no more, or a limit such as ulimit -v is set); "
            "request less at once, or raise the limit"};
  }
  if (dynamic_cast<const schema::Json::exception*>(&error)) {
    return {Cause::bad_input, "the JSON is not in the form that this program writes (" +
                                  words_of(error) + "); write it again, or run `misalign verify`"};
  }
  if (const auto* database = dynamic_cast<const SQLite::Exception*>(&error)) {
    return schema::storage_failure("the catalogue", *database);
  }
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    return {Cause::failure, schema::printable(file->path1().string()) + ": cannot be used (" +
                                file->code().message() + "); check the path and its permissions"};
  }
  return {Cause::failure, "internal error (" + words_of(error) + "); the same command with " +
                              schema::parameter("log_level", "debug") + " may say more"};
}

}  // namespace misalign::search
