// Starts a program as a child process, and says why where it cannot be started.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace misalign::search {

/// Both ends close when this process becomes another one.
class Pipe {
 public:
  /// UserError (failure) if none can be made.
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

/// It reads nothing, and ends with this process.
class ChildProcess {
 public:
  /// `words` are the program, looked for in PATH if it has no slash, and its arguments. `prepare`
  /// is called in the child before the program takes its place, and returns false, with errno set,
  /// if it cannot. UserError (failure): see Pipe.
  ChildProcess(const std::vector<std::string>& words, const std::function<bool()>& prepare);

  /// Why it was not started, as errno says it; 0: it was.
  int error() const { return error_; }
  /// Looks whether it has; never waits.
  bool has_ended();
  void send(int signal) const;

  /// Once it has ended: 128 + n where signal n ended it,
  int exit_code() const;
  double cpu_s() const;
  double memory_mb() const;  ///< the most that it had

 private:
  pid_t process_;
  int error_ = 0, status_ = 0;
  bool has_ended_ = false;
  rusage usage_{};
};

}  // namespace misalign::search
