// Turns any exception into a sentence for people, and never only into a library's words.
#pragma once

#include <exception>

#include "schema/files/user_error.hpp"

namespace misalign::search {

/// A UserError as it is; too little memory, JSON of another shape, the database and the file system
/// by what they mean for who called.
schema::UserError failure_of(const std::exception& error);

/// How the program that is run says failures, of which only it knows options and exit codes.
struct Border {
  schema::NameParameter name_parameter;
  int (*exit_code)(schema::Cause cause);
  int stopped = 0;  ///< the exit code where work remains after a signal or the run's time
};

}  // namespace misalign::search
