// Refuses bad input: collects all faults of a file, each as "problem (why); suggestion".
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "schema/files/file_bytes.hpp"
#include "schema/files/printable.hpp"
#include "schema/files/user_error.hpp"

namespace misalign::schema {

using Json = nlohmann::json;

/// Faults of a file, collected while it is read.
class InputFaults {
 public:
  void add(const std::string& problem, const std::string& why, const std::string& suggestion);
  bool none() const { return count_ == 0; }
  std::size_t count() const { return count_; }
  /// Returns the first kMostListed faults: a file can have millions.
  const std::vector<std::string>& sentences() const { return sentences_; }
  /// Throws a UserError (bad_input) naming `source` and all faults, if there are any.
  void refuse(const std::string& source) const;

 private:
  std::vector<std::string> sentences_;
  std::size_t count_ = 0;
};

/// Reads the keys of a JSON object: absent keys keep their defaults, wrong values are faults.
class ObjectReader {
 public:
  /// Reads `value`; `where` is empty for the document itself, otherwise like "pattern".
  ObjectReader(const Json& value, std::string where, InputFaults& faults);

  /// Returns the value of a key, null if it is absent; marks the key as known.
  const Json* find(const std::string& key);
  /// Returns the value of a key, also null if the file says null.
  const Json* said(const std::string& key);
  void require(const std::string& key, const std::string& suggestion);

  void number(const std::string& key, double& into, double least, double most,
              const std::string& suggestion);
  /// Reads a number, or null for none.
  void number(const std::string& key, std::optional<double>& into, double least, double most,
              const std::string& suggestion);
  void whole(const std::string& key, std::uint64_t& into, std::uint64_t most,
             const std::string& suggestion);
  /// Reads a whole number from `least` on; `too_few` says why not fewer. Its present value is the
  /// suggestion.
  void count(const std::string& key, std::uint32_t& into, std::uint64_t least, std::uint64_t most,
             const std::string& too_few);
  void text(const std::string& key, std::string& into, const std::string& suggestion);
  void boolean(const std::string& key, bool& into, const std::string& suggestion);

  /// Reports every unknown key.
  void refuse_unknown_keys();

  /// Return "pattern.rows", and "pattern.rows = 2" with its value.
  std::string name(const std::string& key) const;
  std::string shown(const std::string& key) const;
  InputFaults& faults() { return faults_; }

 private:
  const Json& value_;
  std::string where_;
  InputFaults& faults_;
  std::vector<std::string> known_;
};

/// Reads the text of a file; UserError (bad_input) if it is missing, unreadable, of another kind,
/// too large or a catalogue, (failure) if the disk fails.
std::string read_input_file(const std::string& path, FileKind kind = FileKind::any);

/// Reads the JSON of a file; UserError (bad_input) also if it is none.
Json read_json_file(const std::string& path, FileKind kind = FileKind::any);

/// Parses a text from `source` as JSON; UserError (bad_input) if it is none.
Json parse_json(const std::string& text, const std::string& source);

/// Parses a text of a database as JSON. Null if it is none, or is nested so deeply that copying or
/// printing it would exhaust the stack.
Json json_of(const Json& text);

/// Returns a number as people write it: 80, 0.4, 1e-09.
std::string shown_number(double value);
/// Returns the largest two-digit number not above x, for a sentence; x > 0 is known to 1e-6 of
/// itself.
double rounded_down(double x);

}  // namespace misalign::schema
