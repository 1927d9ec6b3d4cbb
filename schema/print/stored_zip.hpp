// Packs files into a ZIP archive without compression.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace misalign::schema {

/// An archive of files by name and bytes (PKWARE APPNOTE 6.3, method 0), in their order, dated
/// 1980-01-01, so that equal files make equal archives.
std::string stored_zip(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace misalign::schema
