// The findings of a check of a catalogue.
#pragma once

#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Something that is not as it should be.
struct Finding {
  std::string sentence;
  Json details;  ///< its parts: "where", "column", "stored", "recomputed"
};

/// `where` is like "draw 17".
Finding differs(const std::string& where, const std::string& column, const Json& stored,
                const Json& recomputed);

}  // namespace misalign::schema
