// Reports errors: a sentence for people and its cause, in the terms of each interface.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "solver/studies/option_fault.hpp"

namespace misalign::schema {

enum class Cause {
  failure,      ///< failure of disk, memory or a rank, or a lost path
  bad_request,  ///< wrong options, bad SQL
  bad_input,    ///< missing, damaged or wrong file
  in_use,       ///< used by another process
  foreign,      ///< another campaign, a newer schema, another build
  check_failed
};

/// Returns a parameter for a sentence, by the name of an OptionFault; interfaces rename it.
std::string parameter(std::string_view name, const std::optional<std::string>& value = {});

/// Returns an interface's name of a parameter, with the text before its value: "--from ".
using NameParameter = std::string (*)(std::string_view name, bool has_value);

/// An error. Names and values in its sentence may have any origin: it is made printable, and
/// shortened if it is very long.
class UserError : public std::runtime_error {
 public:
  UserError(Cause cause, const std::string& sentence);
  /// An error with a list, a line each: at most kMostListed, then the number of the others.
  UserError(Cause cause, const std::string& sentence, const std::vector<std::string>& list,
            std::size_t more);
  /// A bad request: "from_deg=200: why; suggestion".
  explicit UserError(const solver::OptionFault& fault);

  Cause cause() const { return cause_; }
  /// Returns the sentence with an interface's names; what() has the Python names of parameters.
  std::string sentence(NameParameter name_parameter) const;

 private:
  Cause cause_;
  std::string marked_;  // the sentence with marked parameters
};

/// Largest number of faults or findings that are listed at once.
inline constexpr std::size_t kMostListed = 20;

/// Returns a text of unknown origin as a part of a sentence, at most `most` bytes.
std::string in_a_sentence(const std::string& text, std::size_t most);

}  // namespace misalign::schema
