// System calls of the program's own that fail, as the kernel of a bad disk or a broken file system
// lets them: in a process of its own, which nothing can undo.
#pragma once

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <functional>

namespace misalign::schema {

/// Calls of this number whose third argument is `third` fail with `error`, as often as they are
/// made.
struct FailingCall {
  long number;
  unsigned third;
  int error;
};

/// What `work` returns where that call fails; -1 if it does not end, -2 if the system has no such
/// filter.
inline int where_fails(const FailingCall& call, const std::function<int()>& work) {
  constexpr unsigned kMost_s = 10;
  constexpr int kNoFilter = 99;
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(kMost_s);
    sock_filter steps[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call.number), 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[2])),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call.third, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<unsigned>(call.error)),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    sock_fprog filter{sizeof steps / sizeof steps[0], steps};
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0) {
      ::_exit(kNoFilter);
    }
    ::_exit(work());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!WIFEXITED(status)) return -1;
  return WEXITSTATUS(status) == kNoFilter ? -2 : WEXITSTATUS(status);
}

}  // namespace misalign::schema
