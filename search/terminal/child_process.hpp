// Starts a program as a child process, and keeps the error if that fails.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace misalign::search {

/// A pipe whose ends close on exec.
class Pipe {
 public:
  /// UserError (failure) if the system refuses.
  Pipe();
  ~Pipe();
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read_end() const { return read_end_; }
  int write_end() const { return write_end_; }
  void close_write_end();

 private:
  int read_end_ = -1, write_end_ = -1;
};

/// Its standard input is empty, and it ends with this process.
class ChildProcess {
 public:
  /// `words` are the program, looked for in PATH if it has no slash, and its arguments. `prepare`
  /// is called in the child before the program takes its place, and returns false, with errno set,
  /// if it cannot. UserError (failure): see Pipe.
  ChildProcess(const std::vector<std::string>& words, const std::function<bool()>& prepare);

  /// The errno of the failed start; 0 after a success.
  int error() const { return error_; }
  /// Returns whether it has ended; never waits.
  bool has_ended();
  void send(int signal) const;

  /// Known once it has ended; the exit code is 128 + n after signal n.
  int exit_code() const;
  double cpu_s() const;
  double memory_mb() const;  ///< maximum

 private:
  pid_t process_;
  int error_ = 0, status_ = 0;
  bool has_ended_ = false;
  rusage usage_{};
};

}  // namespace misalign::search
