// Runs ccx, CalculiX's solver, on a deck, and supervises it.
#pragma once

#include <functional>
#include <string>

namespace misalign::search {

struct CalculixEnd {
  bool was_stopped = false;  ///< true if `goes_on` ended it
  int exit_code = 0;         ///< 128 + n where signal n ended it
  double cpu_s = 0;
  double memory_mb = 0;  ///< peak
};

/// The first ccx in the absolute directories of PATH: relative ones depend on the current
/// directory. UserError (failure) if there is none.
std::string find_calculix();

/// A fresh directory for a run, inside another one: the run reads and follows no file that it did
/// not make. UserError (failure) if it cannot be made.
class RunDirectory {
 public:
  RunDirectory(const std::string& parent, const std::string& job);
  /// Removed if it is empty.
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  const std::string& path() const { return path_; }
  /// Moves the job's files into the parent, replacing those of an earlier run, and removes the
  /// directory. UserError (failure) if it cannot; it stays here then.
  void publish() const;

 private:
  const std::string parent_, job_;
  std::string path_;
};

/// Runs `ccx -i JOB` in a directory until it ends or `goes_on`, called a few times a second,
/// returns false; its output goes to JOB.log there. It ends with this process. UserError (failure)
/// if it cannot be started.
CalculixEnd run_calculix(const std::string& ccx, const std::string& directory,
                         const std::string& job, const std::function<bool()>& goes_on);

/// Endings of a job's files, deck and log among them.
inline constexpr const char* kJobEndings[] = {".inp", ".dat", ".frd", ".sta",
                                              ".cvg", ".12d", ".log"};

/// The absolute path of a job's file.
std::string job_file(const std::string& directory, const std::string& job, const char* ending);

}  // namespace misalign::search
