// Names a file until it is finished, and gives it its final name.
#pragma once

#include <string>
#include <vector>

namespace misalign::schema {

/// NAME.<32 random hexadecimal digits>.partial, beside `output`. UserError (failure) if the system
/// gives no random numbers.
std::string unforeseen_name(const std::string& output);
bool is_unforeseen_name(const std::string& path, const std::string& output);

/// The output that a file of such a name becomes (a long one may be cut); any other path as it is.
std::string output_of(const std::string& path);

/// The names that SQLite gives to journals beside a database.
const std::vector<std::string>& journal_suffixes();

/// Makes the name of a new file outlast a power cut.
void sync_directory_of(const std::string& path);

enum class Existing {
  refused,  ///< a file that is there already stays there
  replaced
};

/// Renames `from` to `to`, in one directory, and makes that outlast a power cut. 0, or an errno:
/// EEXIST where `to` is there and may not be replaced. `from` keeps its name then.
int give_name(const std::string& from, const std::string& to, Existing existing);

// The ways of it where nothing may be replaced, the first that the file system has: a rename that
// refuses (not on NFS, 9p and some FUSE file systems: EINVAL), a second name and the first one
// removed, and a rename over an empty file made for that. 0, or an errno.
int rename_to_new(const std::string& from, const std::string& to);
int link_to_new(const std::string& from, const std::string& to);
int rename_over_empty(const std::string& from, const std::string& to);

/// Whether a name is taken, be it by a link that leads nowhere.
bool is_taken(const std::string& path);

/// UserError (bad_input) that says what is there instead of a file, also where links lead; not
/// where nothing is. `suggestion` ends the sentence.
void check_is_file(const std::string& path, const std::string& suggestion);

/// Where the links at `path` lead, one after the other; `path` itself if it is none. UserError
/// (failure) if they lead in a circle.
std::string end_of_links(const std::string& path);

}  // namespace misalign::schema
