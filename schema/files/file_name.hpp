// Names an unfinished file, and gives it its final name.
#pragma once

#include <string>
#include <vector>

namespace misalign::schema {

/// Returns NAME.<32 random hexadecimal digits>.partial, beside `output`. UserError (failure) if the
/// system gives no random numbers.
std::string unforeseen_name(const std::string& output);
bool is_unforeseen_name(const std::string& path, const std::string& output);

/// Returns the output that a file of such a name becomes (a long name may be cut); any other path
/// unchanged.
std::string output_of(const std::string& path);

/// Returns the suffixes of SQLite's journals beside a database.
const std::vector<std::string>& journal_suffixes();

/// Makes the name of a new file survive a power failure.
void sync_directory_of(const std::string& path);

enum class Existing {
  refused,  ///< an existing file is kept
  replaced
};

/// Renames `from` to `to`, in one directory, so that it survives a power failure. Returns 0, or an
/// errno: EEXIST if `to` exists and may not be replaced; `from` keeps its name then.
int give_name(const std::string& from, const std::string& to, Existing existing);

// Tries the file system's methods that replace nothing, in turn: a rename that refuses (not on NFS,
// 9p and some FUSE file systems: EINVAL), a second name with removal of the first, and a rename
// over an empty file made for that. Returns 0, or an errno.
int rename_to_new(const std::string& from, const std::string& to);
int link_to_new(const std::string& from, const std::string& to);
int rename_over_empty(const std::string& from, const std::string& to);

/// Returns whether a name is taken, even by a link to nothing.
bool is_taken(const std::string& path);

/// Throws a UserError (bad_input) that says what is there instead of a file, also at the end of
/// links; not if nothing is. `suggestion` ends the sentence.
void check_is_file(const std::string& path, const std::string& suggestion);

/// Follows the links at `path` to their end; returns `path` itself if it is none. UserError
/// (failure) if they form a circle.
std::string end_of_links(const std::string& path);

}  // namespace misalign::schema
