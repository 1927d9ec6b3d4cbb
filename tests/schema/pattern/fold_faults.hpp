// Faults for which a FOLD mesh is refused.
#pragma once

#include <string>
#include <vector>

#include "schema/pattern/pattern_file.hpp"
#include "tests/schema/pattern/fold_meshes.hpp"

namespace misalign::schema {

using Words = std::vector<std::string>;

/// What is said against a pattern, each fault a sentence; they are one refusal.
inline std::vector<std::string> pattern_faults(const Json& pattern) {
  InputFaults faults;
  read_pattern(pattern, "", Displacements::allowed, ".", faults);
  if (!faults.none()) {
    try {
      faults.refuse("test");
      ADD_FAILURE() << "faults are no refusal";
    } catch (const UserError& error) {
      EXPECT_EQ(error.cause(), Cause::bad_input);
    }
  }
  return faults.sentences();
}

/// So many sentences, each "problem (why); suggestion" and with all of these words.
inline void expect_faults(const Json& pattern, std::size_t count, const Words& words) {
  const auto faults = pattern_faults(pattern);
  EXPECT_EQ(faults.size(), count) << (faults.empty() ? words[0] : faults[0]);
  for (const std::string& fault : faults) {
    EXPECT_NE(fault.find(" ("), std::string::npos) << fault;
    EXPECT_NE(fault.find("); "), std::string::npos) << fault;
    for (const std::string& word : words) {
      EXPECT_NE(fault.find(word), std::string::npos) << word << " is not in: " << fault;
    }
  }
}

}  // namespace misalign::schema
