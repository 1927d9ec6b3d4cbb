// Writes files that appear under their names only once they are whole: databases, text and copies.
//
// A file lies until then in the same directory under an unpredictable name of this process,
// NAME.<32 hexadecimal digits>.partial, so that no existing file is opened, followed or removed.
// Text is written without a name where the file system can do that (O_TMPFILE): then a killed
// process leaves nothing. SQLite needs names: a database is locked from start to end. The next
// writer of the same output removes unlocked files of that form that belong to this user and are
// no input. On shared storage, where a lock may be invisible, leftovers stay.
#pragma once

#include <sys/stat.h>

#include <string>
#include <string_view>
#include <vector>

#include "schema/files/file_name.hpp"

namespace misalign::schema {

class OutputFile {
 public:
  /// Makes a new database, readable by those who may read all of its sources `originals`.
  /// UserError: bad_request if the output, or a journal beside it, exists; in_use if another
  /// process is writing it; failure if it cannot be written.
  static OutputFile database(const std::string& output, const std::vector<std::string>& originals);
  /// Makes a file of bytes in place of an older one, whose permissions it keeps, and its owner if
  /// the system allows; the target of a link is replaced, not the link. UserError: bad_request if
  /// that is a database, belongs to one, or is an input (keep_inputs); failure if it cannot be
  /// read, so that it may be a database, or cannot be written.
  static OutputFile text(const std::string& output);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  /// Removes an unpublished file.
  ~OutputFile();

  /// Returns the path for writing a database. Its connections must be closed before this object
  /// ends.
  const std::string& path() const { return path_; }
  /// Appends to a text. UserError (failure).
  void write(std::string_view bytes);
  /// Gives the file its name once disk and directory have it. All connections to it must be closed.
  /// UserError: bad_request if the output has appeared meanwhile; failure if it cannot be written,
  /// or SQLite has left a part of it in a journal.
  void publish();

 private:
  OutputFile(const std::string& output, Existing existing);
  void make_named(mode_t mode);
  void make_unnamed();
  void refuse_journals() const;
  [[noreturn]] void refuse(int error) const;

  std::string output_, target_;  // as given, and at the end of links
  Existing existing_;
  std::string path_;  // empty without a name
  int descriptor_ = -1;
};

/// Writes a text file, whole or not at all; see OutputFile::text, also for the errors.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace misalign::schema
