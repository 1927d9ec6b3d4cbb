// Runs ccx, CalculiX's solver, on a deck, and looks after it.
#pragma once

#include <functional>
#include <string>

namespace misalign::search {

struct CalculixEnd {
  bool was_stopped = false;  ///< by `goes_on`
  int exit_code = 0;         ///< 128 + n where signal n ended it
  double cpu_s = 0;
  double memory_mb = 0;  ///< the most that it had
};

/// UserError (1) if there is no ccx.
void find_calculix();

/// Runs `ccx -i JOB` in a directory until it ends or `goes_on`, asked a few times a second, says
/// no; what it prints goes to JOB.log there. It ends with this process. UserError (1) where there
/// is no ccx, or it cannot be started.
CalculixEnd run_calculix(const std::string& directory, const std::string& job,
                         const std::function<bool()>& goes_on);

/// The directory's own name of a job's file.
std::string job_file(const std::string& directory, const std::string& job, const char* ending);

}  // namespace misalign::search
