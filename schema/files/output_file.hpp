// A file that appears under its name only once it is whole: databases, text and copies alike.
//
// Until then it lies in the same directory under a name that nobody can foresee,
// NAME.<32 hexadecimal digits>.partial, made by this process and by none other, so that nothing
// that is there is opened, followed or removed. Text is written without any name where the file
// system can do that (O_TMPFILE): then a process that is killed leaves nothing. SQLite needs names:
// a database is locked from start to end, and whoever writes the same output next removes what is
// of that form, this user's, no input, and locked by nobody. Not so on storage that machines share,
// where a lock may not be seen: what was left stays there.
#pragma once

#include <sys/stat.h>

#include <string>
#include <string_view>
#include <vector>

#include "schema/files/file_name.hpp"

namespace misalign::schema {

class OutputFile {
 public:
  /// A new database, readable by those who may read all of `originals`, which it is made of.
  /// UserError: bad_request the output, or a journal beside it, is there already; in_use another
  /// process is writing it; failure it cannot be written.
  static OutputFile database(const std::string& output, const std::vector<std::string>& originals);
  /// A file of bytes, in place of an older one, whose permissions it keeps, and its owner where the
  /// system lets it; what a link points to is replaced instead of the link. UserError: bad_request
  /// that is a database, or belongs to one, or is an input (keep_inputs); failure it cannot be
  /// read, so that it may be one, or not be written.
  static OutputFile text(const std::string& output);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  /// Removes what was not published.
  ~OutputFile();

  /// Where to write a database. Its connections must be closed before this object ends.
  const std::string& path() const { return path_; }
  /// Adds to a text. UserError (failure).
  void write(std::string_view bytes);
  /// Gives it its name, when disk and directory have it. Every connection to it must be closed.
  /// UserError: bad_request the output has come to be meanwhile; failure it cannot be written, or
  /// SQLite has left a part of it in a journal.
  void publish();

 private:
  OutputFile(const std::string& output, Existing existing);
  void make_named(mode_t mode);
  void make_unnamed();
  void refuse_journals() const;
  [[noreturn]] void refuse(int error) const;

  std::string output_, target_;  // as it was asked for, and where links lead from there
  Existing existing_;
  std::string path_;  // empty while it has none
  int descriptor_ = -1;
};

/// Writes a text file, whole or not at all; see OutputFile::text, also for the errors.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace misalign::schema
