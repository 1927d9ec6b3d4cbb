// Exports a catalogue in a form that SQLite versions from before 2021 can read.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

namespace misalign::schema {

/// Writes a database file of the same tables without STRICT, generated columns, checks and triggers
/// (SQLite 3.8.7, of 2014, was tried), with the views displacements and diagonals as tables, since
/// old readers have no JSON. It is no catalogue any more: search does not go on with it. The file
/// appears whole or not at all. UserError: see OutputFile::database and storage_failure; 3 if the
/// catalogue is damaged.
void export_plain(SQLite::Database& catalogue, const std::string& output);

}  // namespace misalign::schema
