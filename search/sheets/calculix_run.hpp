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

/// The first ccx in the directories of PATH that are absolute: what the others mean depends on
/// where one is. UserError (failure) if there is none.
std::string find_calculix();

/// A fresh directory for a run, inside of another one: nothing in it can be read, run or followed
/// that the run did not make. UserError (failure) if it cannot be made.
class RunDirectory {
 public:
  RunDirectory(const std::string& parent, const std::string& job);
  /// Removed if it is empty.
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  const std::string& path() const { return path_; }
  /// What the run has made of its job goes into the parent, in place of what an earlier run left,
  /// and the directory is removed. UserError (failure) if it cannot; it stays here then.
  void publish() const;

 private:
  const std::string parent_, job_;
  std::string path_;
};

/// Runs `ccx -i JOB` in a directory until it ends or `goes_on`, asked a few times a second, says
/// no; what it prints goes to JOB.log there. It ends with this process. UserError (failure) if it
/// cannot be started.
CalculixEnd run_calculix(const std::string& ccx, const std::string& directory,
                         const std::string& job, const std::function<bool()>& goes_on);

/// What ccx may leave of a job, deck and log among them.
inline constexpr const char* kJobEndings[] = {".inp", ".dat", ".frd", ".sta",
                                              ".cvg", ".12d", ".log"};

/// The directory's own name of a job's file.
std::string job_file(const std::string& directory, const std::string& job, const char* ending);

}  // namespace misalign::search
