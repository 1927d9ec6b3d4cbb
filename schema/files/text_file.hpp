// Writes text files, whole or not at all.
#pragma once

#include <string>

namespace misalign::schema {

/// A full disk leaves no half of a file under its name; an older file of that name is replaced. See
/// OutputFile::text, also for the errors.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace misalign::schema
