// Files that are written whole or not at all.
#pragma once

#include <string>

namespace misalign::schema {

/// A full disk leaves no half of a file under its name; an older file of that name is replaced,
/// what a link points to instead of the link. UserError (1) with the cause.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace misalign::schema
