#include "tests/simulation/machine.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

namespace misalign::simulation {
namespace {

constexpr std::size_t kStack_bytes = 1 << 20;
// A job that lasts longer hangs, as one does of which all wait for ever.
constexpr Nanoseconds kLongest = 3600 * kSecond;
constexpr int kHangs = 99;
constexpr Nanoseconds kNever = std::numeric_limits<Nanoseconds>::max();
// Virtual time begins with 2026, so that dates are dates.
constexpr Nanoseconds kBegin = 1'767'225'600 * kSecond;

// A thread's exceptions, which another thread's turn must not touch.
struct Exceptions {
  void* caught;
  unsigned uncaught;
};
Exceptions& exceptions() {
  return *reinterpret_cast<Exceptions*>(reinterpret_cast<void*>(abi::__cxa_get_globals()));
}

// A thread of a rank; its first one is the rank's program.
struct Thread {
  int rank;
  std::function<void()> work;
  std::unique_ptr<char[]> stack;
  ucontext_t context;
  Nanoseconds wakes_at;
  const void* waits_for = nullptr;  // a condition variable
  bool is_done = false;
  Exceptions kept{};
};

class Machine {
 public:
  explicit Machine(const Job& job) : job_(job), random_(job.seed), exit_codes_(job.ranks, -1) {}

  [[noreturn]] void run() {
    for (int rank = 0; rank < job_.ranks; ++rank) {
      spawn(rank, [this, rank] { leave(rank, job_.run(rank)); });
    }
    for (;;) {
      const auto next = std::ranges::min_element(
          threads_, {}, [](const auto& thread) { return thread->wakes_at; });
      const Nanoseconds then = std::min((*next)->wakes_at, killed_at_);
      if (then > kLongest) end_job(kHangs);
      advance_to(then);
      if ((*next)->wakes_at <= now_) give_turn(**next);
    }
  }

  std::size_t spawn(int rank, std::function<void()> work) {
    auto thread = std::make_unique<Thread>();
    thread->rank = rank;
    thread->work = std::move(work);
    thread->stack.reset(new char[kStack_bytes]);
    thread->wakes_at = now_ + static_cast<Nanoseconds>(up_to(random_, kMillisecond));
    getcontext(&thread->context);
    thread->context.uc_stack = {
        .ss_sp = thread->stack.get(), .ss_flags = 0, .ss_size = kStack_bytes};
    thread->context.uc_link = &scheduler_;
    makecontext(&thread->context, reinterpret_cast<void (*)()>(begin), 0);
    threads_.push_back(std::move(thread));
    return threads_.size() - 1;
  }

  void sleep_until(Nanoseconds time) {
    Thread& thread = *running_;
    thread.wakes_at = std::max(time, now_);
    swapcontext(&thread.context, &scheduler_);
  }

  // Waits for a condition variable; false if the time is over.
  bool wait_for(const void* condition, Nanoseconds until) {
    running_->waits_for = condition;
    sleep_until(until);
    return std::exchange(running_->waits_for, nullptr) == nullptr;
  }
  void notify(const void* condition) {
    for (const auto& thread : threads_) {
      if (thread->waits_for != condition) continue;
      thread->waits_for = nullptr;
      thread->wakes_at = now_;
    }
  }

  // A rank ends; with an error its launcher ends the others within a second.
  void leave(int rank, int exit_code) {
    exit_codes_[rank] = exit_code;
    for (const auto& thread : threads_) {
      if (thread->rank == rank) thread->wakes_at = kNever;
    }
    const bool all_left = std::ranges::count(exit_codes_, -1) == 0;
    if (exit_code != 0 && first_failure_ == 0) first_failure_ = exit_code;
    if (all_left) end_job(first_failure_);
    if (exit_code != 0) killed_at_ = std::min(killed_at_, now_ + within(kSecond));
    swapcontext(&running_->context, &scheduler_);
  }

  // Delivers what happens until then.
  void advance_to(Nanoseconds time) {
    while (next_ < job_.happenings.size() && job_.happenings[next_].at <= time && !is_away_) {
      const Happening& happening = job_.happenings[next_++];
      now_ = std::max(now_, happening.at);
      is_away_ = true;
      happen(happening);
      is_away_ = false;
    }
    now_ = std::max(now_, time);
    if (now_ < killed_at_) return;
    if (first_failure_ != 0) end_job(first_failure_);
    raise(SIGKILL);
  }

  Nanoseconds within(Nanoseconds longest) {
    return static_cast<Nanoseconds>(up_to(random_, static_cast<std::uint64_t>(longest)));
  }
  const Job& job() const { return job_; }
  Nanoseconds now() const { return now_; }
  int rank() const { return running_ ? running_->rank : 0; }
  Thread& thread(std::size_t number) { return *threads_[number]; }
  Random& random() { return random_; }
  bool has_threads() const { return running_ != nullptr; }
  bool is_urgent() const { return is_urgent_; }

 private:
  static void begin();

  void give_turn(Thread& thread) {
    running_ = &thread;
    std::swap(exceptions(), thread.kept);
    swapcontext(&scheduler_, &thread.context);
    std::swap(exceptions(), thread.kept);
    running_ = nullptr;
  }

  void happen(const Happening& happening) {
    if (happening.kind == Happening::pause_job) return job_.stand_still(happening.number);
    if (happening.kind == Happening::silence) {
      for (const auto& thread : threads_) {
        if (thread->rank == happening.number) thread->wakes_at = kNever;
      }
      return;
    }
    is_urgent_ = true;
    job_.is_asked(now_);
    const bool ends = happening.number == SIGTERM || happening.number == SIGINT;
    if (job_.ranks > 1 && ends) killed_at_ = std::min(killed_at_, now_ + kSecond);
    raise(happening.number);
  }

  const Job& job_;
  Random random_;
  std::vector<std::unique_ptr<Thread>> threads_;
  std::vector<int> exit_codes_;  // of the ranks; -1: at work
  ucontext_t scheduler_;
  Thread* running_ = nullptr;
  Nanoseconds now_ = 0, killed_at_ = kNever;
  std::size_t next_ = 0;
  int first_failure_ = 0;
  bool is_urgent_ = false, is_away_ = false;
};

Machine* machine = nullptr;

void Machine::begin() {
  Thread& thread = *machine->running_;
  thread.work();
  thread.is_done = true;
  machine->sleep_until(kNever);
}

}  // namespace

void run_job(const Job& job) {
  Machine of_job(job);
  machine = &of_job;
  of_job.run();
}

bool is_running() { return machine != nullptr; }
int rank_here() { return machine->rank(); }
int ranks_here() { return machine->job().ranks; }
Nanoseconds now() { return machine->now(); }
void compute(Nanoseconds duration) { machine->sleep_until(machine->now() + duration); }
void pass(Nanoseconds duration) {
  if (machine) machine->advance_to(machine->now() + duration);
}
Random& machine_random() { return machine->random(); }
void end_job(int exit_code) {
  if (machine) machine->job().has_ended(machine->now());
  std::fflush(nullptr);
  syscall(SYS_exit_group, exit_code);
  std::abort();
}

namespace {

Nanoseconds of(const timespec& time) { return time.tv_sec * kSecond + time.tv_nsec; }

// The end of a sleep, which lasts longer on a busy machine; before anybody is asked to stop many
// times longer, since those who only look for that need not be watched looking.
Nanoseconds awake_after(Nanoseconds asked) {
  const Nanoseconds most = machine->is_urgent() ? asked / 2 : 20 * asked;
  return machine->now() + asked + machine->within(std::max<Nanoseconds>(most, 1));
}

constexpr pthread_t kFirstThread = 1000;

}  // namespace
}  // namespace misalign::simulation

// The C library's functions of these names; outside of a job they do what it does.
extern "C" {
using namespace misalign::simulation;

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  if (!machine) return static_cast<int>(syscall(SYS_clock_gettime, clock, time));
  const Nanoseconds at = machine->now() + (clock == CLOCK_REALTIME ? kBegin : kSecond);
  *time = {at / kSecond, at % kSecond};
  return 0;
}

int gettimeofday(timeval* time, void*) noexcept {
  timespec precise{};
  clock_gettime(CLOCK_REALTIME, &precise);
  *time = {precise.tv_sec, precise.tv_nsec / 1000};
  return 0;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* asked, timespec* left) {
  if (!machine || !machine->has_threads()) {
    return static_cast<int>(syscall(SYS_clock_nanosleep, clock, flags, asked, left));
  }
  machine->sleep_until(awake_after(of(*asked)));
  return 0;
}

int nanosleep(const timespec* asked, timespec* left) {
  return clock_nanosleep(CLOCK_REALTIME, 0, asked, left);
}

int usleep(useconds_t microseconds) {
  const timespec asked{microseconds / 1000000, microseconds % 1000000 * 1000};
  return nanosleep(&asked, nullptr);
}

int pause() {
  machine->sleep_until(kNever);
  return -1;
}

int pthread_create(pthread_t* thread, const pthread_attr_t*, void* (*start)(void*),
                   void* argument) noexcept {
  if (!machine) std::abort();
  *thread = kFirstThread + machine->spawn(machine->rank(), [=] { start(argument); });
  return 0;
}

int pthread_join(pthread_t thread, void**) {
  while (!machine->thread(thread - kFirstThread).is_done) compute(kMillisecond);
  return 0;
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const timespec* until) {
  timespec now{};
  clock_gettime(clock, &now);
  pthread_mutex_unlock(mutex);
  const bool in_time = machine->wait_for(condition, awake_after(of(*until) - of(now)));
  pthread_mutex_lock(mutex);
  return in_time ? 0 : ETIMEDOUT;
}

int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
  if (machine) machine->notify(condition);
  return 0;
}

// A rank that exits leaves its launcher with its exit code.
void _exit(int exit_code) {
  if (machine && machine->has_threads() && machine->rank() > 0)
    machine->leave(machine->rank(), exit_code);
  end_job(exit_code);
}

// Each rank has its number from its launcher.
char* getenv(const char* name) noexcept {
  static const auto real = reinterpret_cast<char* (*)(const char*)>(dlsym(RTLD_NEXT, "getenv"));
  if (!machine || ranks_here() == 1 || std::strncmp(name, "OMPI_COMM_WORLD_", 16) != 0) {
    return real(name);
  }
  static char number[8];
  const bool asks_size = std::strcmp(name, "OMPI_COMM_WORLD_SIZE") == 0;
  std::snprintf(number, sizeof number, "%d", asks_size ? ranks_here() : rank_here());
  return number;
}
}
