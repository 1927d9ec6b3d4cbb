// Refusing bad input at the door: every fault of a file at once, each as "problem (why);
// suggestion".
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace misalign::schema {

using Json = nlohmann::json;

/// A sentence for the person who called, and the exit code of the contract.
class UserError : public std::runtime_error {
 public:
  UserError(int exit_code, const std::string& sentence)
      : std::runtime_error(sentence), exit_code_(exit_code) {}
  int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

inline constexpr int kExitFailure = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitBadInput = 3;
inline constexpr int kExitInUse = 4;
inline constexpr int kExitOtherCampaign = 5;
inline constexpr int kExitCheckFailed = 6;
inline constexpr int kExitWorkRemains = 75;

/// What is wrong with a file, collected while reading goes on.
class InputFaults {
 public:
  void add(const std::string& problem, const std::string& why, const std::string& suggestion);
  bool none() const { return sentences_.empty(); }
  const std::vector<std::string>& sentences() const { return sentences_; }
  /// Throws a UserError (3) naming `source` and every fault, unless there is none.
  void refuse(const std::string& source) const;

 private:
  std::vector<std::string> sentences_;
};

/// Reads the keys of one JSON object; what is absent keeps its default, what is wrong is a fault.
class ObjectReader {
 public:
  /// `where` is empty for the document itself, otherwise like "pattern".
  ObjectReader(const Json& value, std::string where, InputFaults& faults);

  /// The value of a key, null if it is absent; marks the key as known.
  const Json* find(const std::string& key);
  void require(const std::string& key, const std::string& suggestion);

  void number(const std::string& key, double& into, double least, double most,
              const std::string& suggestion);
  void whole(const std::string& key, std::uint64_t& into, std::uint64_t most,
             const std::string& suggestion);
  void flag(const std::string& key, bool& into);
  void text(const std::string& key, std::string& into, const std::string& suggestion);

  /// Reports every key that nobody asked for.
  void refuse_unknown_keys();

  /// "pattern.rows", and "pattern.rows = 2" with its value.
  std::string name(const std::string& key) const;
  std::string shown(const std::string& key) const;
  InputFaults& faults() { return faults_; }

 private:
  const Json& value_;
  std::string where_;
  InputFaults& faults_;
  std::vector<std::string> known_;
};

/// The JSON in a file; UserError (3) if it is missing, unreadable or not JSON.
Json read_json_file(const std::string& path);

/// The JSON in a text that came from `source`; UserError (3) if it is none.
Json parse_json(const std::string& text, const std::string& source);

/// A number as people write it: 80, 0.4, 1e-09.
std::string shown_number(double value);

/// The same in a format of printf for one double.
std::string shown_number(const char* format, double value);

/// A text for a sentence: control characters, which could end it or change what a terminal shows,
/// as \u0000.
std::string printable(const std::string& text);

/// A text of unknown origin, with U+FFFD for what is no UTF-8 in it: JSON has no other.
std::string utf8(const std::string& text);

}  // namespace misalign::schema
