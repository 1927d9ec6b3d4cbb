#include "search/watch/folded_sheets.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "schema/files/input.hpp"
#include "schema/files/memory_file.hpp"
#include "search/terminal/child_process.hpp"

namespace misalign::search {
namespace {

constexpr std::chrono::milliseconds kLook{20};
constexpr int kData = 1, kMessage = 2;  // descriptors of the child

bool become_output(int descriptor, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  return file >= 0 && dup2(file, descriptor) == descriptor;
}

// Unblocks all signals in the child, which this process blocks to wait for them.
bool take_signals() {
  sigset_t all;
  sigfillset(&all);
  return sigprocmask(SIG_UNBLOCK, &all, nullptr) == 0;
}

// Returns a program's error message without its name.
std::string sentence_of(std::string message) {
  constexpr std::string_view kName = "misalign: ";
  if (message.starts_with(kName)) message.erase(0, kName.size());
  while (message.ends_with('\n')) message.pop_back();
  return message.empty() ? "the sheet cannot be folded (its program ended without a message)"
                         : message;
}

// Returns the answer from the report of one draw.
std::string answer_of(const std::string& text) {
  const schema::Json report = schema::Json::parse(text);
  return schema::Json({{"detail", report.at("details").at(0)},
                       {"identity", report.at("campaign").at("identity")}})
      .dump();
}

}  // namespace

PageResponse FoldedSheets::sheet(std::uint64_t draw, const std::function<bool()>& has_gone) {
  if (!wait_for_turn(has_gone)) {
    return problem_response(503, "newer requests came first; request this sheet again");
  }
  PageResponse answer;
  try {
    answer = folded(draw, has_gone);
  } catch (const std::exception& error) {
    answer = problem_response(503, error.what());
  }
  const std::lock_guard lock(asking_);
  is_folding_ = false;
  changes_.notify_all();
  return answer;
}

void FoldedSheets::end() {
  const std::lock_guard lock(asking_);
  has_ended_ = true;
  changes_.notify_all();
}

bool FoldedSheets::has_ended() {
  const std::lock_guard lock(asking_);
  return has_ended_;
}

bool FoldedSheets::wait_for_turn(const std::function<bool()>& has_gone) {
  std::unique_lock lock(asking_);
  const std::uint64_t mine = ++requests_;
  waiting_.insert(mine);
  if (waiting_.size() > kMostWaiting) waiting_.erase(waiting_.begin());
  changes_.notify_all();
  while (!has_ended_ && waiting_.contains(mine) && !has_gone()) {
    if (!is_folding_ && mine == *waiting_.rbegin()) {
      waiting_.erase(mine);
      return is_folding_ = true;
    }
    changes_.wait_for(lock, 10 * kLook);
  }
  waiting_.erase(mine);
  changes_.notify_all();
  return false;
}

PageResponse FoldedSheets::folded(std::uint64_t draw, const std::function<bool()>& has_gone) {
  const schema::MemoryFile data("the sheet"), message("the sheet");
  const std::string data_path = data.path(), message_path = message.path();
  ChildProcess child(command_(draw), [&] {
    return take_signals() && become_output(kData, data_path) &&
           become_output(kMessage, message_path);
  });
  if (child.error() != 0) {
    return problem_response(503, "the program that folds the sheet cannot be started");
  }
  while (!child.has_ended()) {
    if (has_ended() || has_gone()) child.send(SIGKILL);
    std::this_thread::sleep_for(kLook);
  }
  if (child.exit_code() != 0) return problem_response(503, sentence_of(message.bytes()));
  return json_response(200, answer_of(data.bytes()));
}

}  // namespace misalign::search
