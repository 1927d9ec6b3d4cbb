#include "schema/catalogue/journal_check.hpp"

#include <filesystem>
#include <string_view>

#include "schema/files/file_bytes.hpp"
#include "schema/files/file_name.hpp"
#include "schema/files/user_error.hpp"

namespace misalign::schema {
namespace {

// End of a journal with a super-journal, by SQLite's pager.c, readSuperJournal: the name, its
// length and checksum of 4 bytes each, and these 8 bytes.
constexpr std::string_view kMagic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
constexpr std::size_t kLeast_bytes = 16;

}  // namespace

void check_journals(const std::string& database_path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path database = fs::canonical(database_path, error);
  if (error) return;  // a missing journal is reported by opening the file
  for (const std::string& suffix : journal_suffixes()) {
    const std::string path = database.string() + suffix;
    const fs::file_type type = fs::symlink_status(path, error).type();
    if (type == fs::file_type::regular || type == fs::file_type::not_found) continue;
    throw UserError(Cause::bad_input,
                    path +
                        ": is no regular file (a catalogue's journals are); take it "
                        "away, or put a backup of the catalogue in another place");
  }
  const std::string journal = database.string() + "-journal";
  const std::string end = end_of_file(journal, kLeast_bytes);
  if (end.size() < kLeast_bytes || !end.ends_with(kMagic)) return;
  throw UserError(Cause::bad_input,
                  journal +
                      ": is the journal of a transaction over several files (SQLite would "
                      "open and delete those that it names, and misalign never makes one); "
                      "put a backup of the catalogue in another place");
}

}  // namespace misalign::schema
