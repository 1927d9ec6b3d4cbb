// Programs of any system as children: what is known of them when they end, or never began.
#include "search/terminal/child_process.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "schema/files/input.hpp"
#include "search/sheets/calculix_run.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

bool nothing_to_prepare() { return true; }

ChildProcess& ended(ChildProcess&& child) {
  while (!child.has_ended()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return child;
}

ChildProcess shell(const std::string& commands) {
  return ChildProcess({"sh", "-c", commands}, nothing_to_prepare);
}

TEST(ChildProcess, AMissingProgramIsSaidAsErrnoSaysIt) {
  for (const char* name : {"no-such-program-of-misalign", "/no/such/program"}) {
    const ChildProcess child({name}, nothing_to_prepare);
    EXPECT_STREQ(std::strerror(child.error()), "No such file or directory") << name;
  }
  const ChildProcess folder({"/"}, nothing_to_prepare);
  EXPECT_EQ(folder.error(), EACCES);
}

TEST(ChildProcess, WhatCannotBePreparedIsNotStarted) {
  const Folder folder("child_process");
  const std::string mark = folder.file("was-started");
  const ChildProcess child({"touch", mark}, [] {
    errno = ENOTDIR;
    return false;
  });
  EXPECT_EQ(child.error(), ENOTDIR);
  EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST(ChildProcess, ExitCodesAreTheProgramsOrTheSignals) {
  EXPECT_EQ(ended(shell("true")).exit_code(), 0);
  EXPECT_EQ(ended(shell("exit 7")).exit_code(), 7);
  EXPECT_EQ(ended(shell("kill -KILL $$")).exit_code(), 128 + SIGKILL);
  ChildProcess sleeping({"sleep", "1000"}, nothing_to_prepare);
  ASSERT_EQ(sleeping.error(), 0);
  EXPECT_FALSE(sleeping.has_ended());
  sleeping.send(SIGTERM);
  EXPECT_EQ(ended(std::move(sleeping)).exit_code(), 128 + SIGTERM);
}

TEST(ChildProcess, ItReadsNothingAndWritesWhereItIsTold) {
  Pipe pipe;
  ChildProcess child({"sh", "-c", "cat; echo done"},
                     [&] { return dup2(pipe.write_end(), STDOUT_FILENO) >= 0; });
  pipe.close_write_end();
  char bytes[16] = {};
  EXPECT_EQ(read(pipe.read_end(), bytes, sizeof bytes), 5);
  EXPECT_STREQ(bytes, "done\n");
  EXPECT_EQ(read(pipe.read_end(), bytes, sizeof bytes), 0);  // nobody else holds the pipe
  ended(std::move(child));
  EXPECT_GT(child.memory_mb(), 0.1);
}

TEST(ChildProcess, CalculixThatCannotBeStartedIsOneSentence) {
  const Folder folder("child_process");
  try {
    run_calculix("/no/such/ccx", folder.path().string(), "job", [] { return true; });
    FAIL();
  } catch (const schema::UserError& error) {
    EXPECT_STREQ(error.what(),
                 "/no/such/ccx: cannot be started (No such file or directory); try it by hand, "
                 "with -i job");
  }
}

}  // namespace
}  // namespace misalign::search
