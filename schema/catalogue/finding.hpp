// Findings of a check of a catalogue.
#pragma once

#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// A deviation from what must hold.
struct Finding {
  std::string sentence;
  Json details;  ///< {"where", "column", "stored", "recomputed"}
};

/// Returns the finding of a value that differs; `where` is like "draw 17".
Finding differs(const std::string& where, const std::string& column, const Json& stored,
                const Json& recomputed);

}  // namespace misalign::schema
