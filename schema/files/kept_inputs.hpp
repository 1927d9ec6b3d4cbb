// Remembers files that were read, so that no output replaces them.
#pragma once

#include <sys/stat.h>

namespace misalign::schema {

/// Keeps from now on every regular file that read_file reads: OutputFile::text does not replace it.
/// Only programs with a single task call it; the caller of a module may want to overwrite an input.
void keep_inputs();

/// Notes an input; does nothing before keep_inputs().
void note_input(const struct stat& file);
bool is_input(const struct stat& file);

}  // namespace misalign::schema
