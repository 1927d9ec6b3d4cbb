// Holds the files of schema/, and the page made of schema/report/, compiled into the program so
// that it runs from anywhere.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace misalign::schema {

struct CarriedFile {
  std::string path;  ///< "schema/queries/best.sql"; "report_page.html"
  std::string text;
};

const std::vector<CarriedFile>& carried_files();

/// Returns the text of a file, which must exist.
inline const std::string& carried_text(const std::string& path) {
  for (const CarriedFile& file : carried_files()) {
    if (file.path == path) return file.text;
  }
  throw std::logic_error(path + " is not carried");
}

}  // namespace misalign::schema
