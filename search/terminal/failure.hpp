// Turns any exception into a sentence for people, not only a library's message.
#pragma once

#include <exception>

#include "schema/files/user_error.hpp"

namespace misalign::search {

/// Returns a UserError unchanged; translates errors of memory, JSON, database and file system.
schema::UserError failure_of(const std::exception& error);

/// The running program's option names and exit codes, with which failures are reported.
struct Border {
  schema::NameParameter name_parameter;
  int (*exit_code)(schema::Cause cause);
  int stopped = 0;  ///< the exit code where work remains after a signal or the run's time
};

}  // namespace misalign::search
