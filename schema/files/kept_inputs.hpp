// Files that were read, so that no output takes their place.
#pragma once

#include <sys/stat.h>

namespace misalign::schema {

/// From now on every regular file that read_file reads is kept: OutputFile::text does not replace
/// it. For a program that does one thing; a module's caller may mean to write what he has read.
void keep_inputs();

/// Nothing before keep_inputs().
void note_input(const struct stat& file);
bool is_input(const struct stat& file);

}  // namespace misalign::schema
