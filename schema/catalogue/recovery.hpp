// Recovers a catalogue that a killed program left, or a copy of one file of two.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

namespace misalign::schema {

/// Leaves one plain file: rolls unfinished transactions back and folds the log in. UserError as
/// from Catalogue's constructor, for any campaign.
void recover(const std::string& path);

/// Checks a catalogue of today's schema whose log is missing. A log that was removed takes its
/// commits with it: their draws are made again, unless some of their pages were folded in and
/// others were not. UserError (bad_input).
void expect_sound_without_log(SQLite::Database& database, const std::string& path);

/// Recovers the file if a journal beside it must be rolled back, which a reader may not do: before
/// a verb reads what it will write. Waits while another process writes there.
void recover_before_writing(const std::string& path);

}  // namespace misalign::schema
