// Refuses what cannot be done: a sentence for people and its cause, which borders make their own.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "solver/studies/option_fault.hpp"

namespace misalign::schema {

enum class Cause {
  failure,      ///< of disk, memory, a rank, or a path that is lost
  bad_request,  ///< options that do not fit, bad SQL
  bad_input,    ///< a file that is missing, damaged or of another kind
  in_use,       ///< by another process
  foreign,      ///< another campaign, a newer schema, another build
  check_failed
};

/// A parameter within a sentence, by the name of an OptionFault; every border calls it its own way.
std::string parameter(std::string_view name, const std::optional<std::string>& value = {});

/// What a border calls a parameter, with what stands before its value: "--from " or "--from".
using NameParameter = std::string (*)(std::string_view name, bool has_value);

/// Names and values in the sentence may come from anywhere: it is printable, and shortened where it
/// is longer than any of ours.
class UserError : public std::runtime_error {
 public:
  UserError(Cause cause, const std::string& sentence);
  /// The same with a list, a line each: at most kMostListed, then how many more there are.
  UserError(Cause cause, const std::string& sentence, const std::vector<std::string>& list,
            std::size_t more);
  /// A bad request: "from_deg=200: why; suggestion".
  explicit UserError(const solver::OptionFault& fault);

  Cause cause() const { return cause_; }
  /// what(), in which parameters have their Python names, in the words of another border.
  std::string sentence(NameParameter name_parameter) const;

 private:
  Cause cause_;
  std::string marked_;  // the sentence before its parameters have a name
};

/// Of faults or findings that people are told at once.
inline constexpr std::size_t kMostListed = 20;

/// A text of unknown origin as a part of a sentence, `most` bytes at most.
std::string in_a_sentence(const std::string& text, std::size_t most);

}  // namespace misalign::schema
