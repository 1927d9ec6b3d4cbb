// Campaigns with one thing changed, and what is said of them.
#pragma once

#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"

namespace misalign::schema {

/// The smallest campaign of the paper's sheet.
inline Json minimal() { return {{"pattern", {{"family", "miura"}, {"rows", 6}, {"columns", 6}}}}; }

inline Json with(const Json& patch) {
  Json campaign = minimal();
  campaign.merge_patch(patch);
  return campaign;
}
inline Json with(const char* patch) { return with(Json::parse(patch)); }

inline Campaign read(const Json& value) { return read_campaign(value, "test"); }

/// The sentences of a refusal, one each; empty if the campaign is accepted.
inline std::vector<std::string> faults_of(const Json& value) {
  try {
    read(value);
    return {};
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_input);
    std::string text = error.what();
    EXPECT_EQ(text.find("test: "), 0u) << text;
    text = text.substr(6);
    const std::size_t list = text.find(" faults\n  ");
    if (list == std::string::npos) return {text};
    const std::size_t announced = std::stoul(text);
    text = text.substr(list + 10);
    std::vector<std::string> sentences;
    for (std::size_t at; (at = text.find("\n  ")) != std::string::npos;
         text = text.substr(at + 3)) {
      sentences.push_back(text.substr(0, at));
    }
    sentences.push_back(text);
    EXPECT_EQ(sentences.size(), announced);
    return sentences;
  }
}

/// Expects exactly one fault, whose sentence has all of these words.
inline void expect_fault(const Json& value, const std::vector<std::string>& words) {
  const auto faults = faults_of(value);
  ASSERT_EQ(faults.size(), 1u) << value << (faults.empty() ? "" : "\n" + faults[0] + "...");
  for (const std::string& word : words) {
    EXPECT_NE(faults[0].find(word), std::string::npos) << word << " is not in: " << faults[0];
  }
}

}  // namespace misalign::schema
