// The catalogues of tests/fixtures: one of each schema version since release 1.0.0, and three that
// an older program made and release 1.0.0 brought up to version 7.
#pragma once

#include <string>

namespace misalign {

struct OlderCatalogue {
  std::string name;
  int version;          ///< of its schema
  int first = version;  ///< that it was made in

  std::string path() const { return std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/" + name; }
};

inline const OlderCatalogue kOlderCatalogues[] = {
    {"catalogue-7-from-1.db", 7, 1}, {"catalogue-7-from-2.db", 7, 2},
    {"catalogue-7-from-3.db", 7, 3}, {"catalogue-7.db", 7},
    {"catalogue-8.db", 8},           {"catalogue-9.db", 9},
    {"catalogue-10.db", 10}};

}  // namespace misalign
