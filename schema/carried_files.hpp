// Files of schema/, and the page made of schema/report/, compiled into the program, so that it runs
// from anywhere.
#pragma once

#include <string>
#include <vector>

namespace misalign::schema {

struct CarriedFile {
  std::string path;  ///< "schema/queries/best.sql"; "report_page.html"
  std::string text;
};

const std::vector<CarriedFile>& carried_files();

}  // namespace misalign::schema
