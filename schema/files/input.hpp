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

/// What is wrong with a file, collected while reading goes on.
class InputFaults {
 public:
  void add(const std::string& problem, const std::string& why, const std::string& suggestion);
  bool none() const { return count_ == 0; }
  std::size_t count() const { return count_; }
  /// The first kMostListed of them: a file can have millions.
  const std::vector<std::string>& sentences() const { return sentences_; }
  /// Throws a UserError (bad_input) naming `source` and every fault, unless there is none.
  void refuse(const std::string& source) const;

 private:
  std::vector<std::string> sentences_;
  std::size_t count_ = 0;
};

/// Reads the keys of one JSON object; what is absent keeps its default, what is wrong is a fault.
class ObjectReader {
 public:
  /// `where` is empty for the document itself, otherwise like "pattern".
  ObjectReader(const Json& value, std::string where, InputFaults& faults);

  /// The value of a key, null if it is absent; marks the key as known.
  const Json* find(const std::string& key);
  /// The same, also null where null says that there is none.
  const Json* said(const std::string& key);
  void require(const std::string& key, const std::string& suggestion);

  void number(const std::string& key, double& into, double least, double most,
              const std::string& suggestion);
  /// The same, or null for none.
  void number(const std::string& key, std::optional<double>& into, double least, double most,
              const std::string& suggestion);
  void whole(const std::string& key, std::uint64_t& into, std::uint64_t most,
             const std::string& suggestion);
  /// A whole number from `least` on; `too_few` says why no less. What it is by itself is tried.
  void count(const std::string& key, std::uint32_t& into, std::uint64_t least, std::uint64_t most,
             const std::string& too_few);
  void text(const std::string& key, std::string& into, const std::string& suggestion);
  void boolean(const std::string& key, bool& into, const std::string& suggestion);

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

/// The text of a file; UserError (bad_input) if it is missing, unreadable, of another kind, too
/// large or a catalogue, (failure) if the disk fails.
std::string read_input_file(const std::string& path, FileKind kind = FileKind::any);

/// The JSON in a file; UserError (bad_input) also if it is none.
Json read_json_file(const std::string& path, FileKind kind = FileKind::any);

/// The JSON in a text that came from `source`; UserError (bad_input) if it is none.
Json parse_json(const std::string& text, const std::string& source);

/// The JSON in a text of a database, null if there is none: also where it is nested more deeply
/// than any of ours, which would exhaust the stack of who copies or prints it.
Json json_of(const Json& text);

/// A number as people write it: 80, 0.4, 1e-09.
std::string shown_number(double value);
/// The largest two-digit number not above x, for a sentence; x > 0 is known to 1e-6 of itself.
double rounded_down(double x);

}  // namespace misalign::schema
