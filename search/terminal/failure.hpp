// Turns any exception into a sentence for people, and never only into a library's words.
#pragma once

#include <exception>
#include <string>

namespace misalign::search {

struct Failure {
  int exit_code;  ///< of the contract
  std::string sentence;
};

/// A UserError as it is; too little memory, JSON of another shape, the database and the file system
/// by what they mean for who called.
Failure failure_of(const std::exception& error);

}  // namespace misalign::search
