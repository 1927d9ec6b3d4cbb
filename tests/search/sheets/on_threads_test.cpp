// Every piece is done once, whatever the threads; what is thrown comes out, and ends the work.
#include "search/sheets/on_threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <string>

namespace misalign::search {
namespace {

const auto square = [](std::size_t) { return [](std::size_t k) { return k * k; }; };

TEST(OnThreads, EveryPieceIsTakenOnceByOneAtATime) {
  for (const std::size_t threads : {0u, 1u, 2u, 7u, 100u}) {
    for (const std::size_t pieces : {0u, 1u, 5u, 1000u}) {
      std::vector<std::size_t> taken(pieces, 0);
      std::atomic<int> inside = 0;
      on_threads(threads, pieces, square, [&](std::size_t k, std::size_t result) {
        EXPECT_EQ(++inside, 1);
        EXPECT_EQ(result, k * k);
        ++taken[k];
        --inside;
        return true;
      });
      EXPECT_EQ(std::count(taken.begin(), taken.end(), 1u), static_cast<std::ptrdiff_t>(pieces));
    }
  }
}

TEST(OnThreads, EachThreadBeginsOnce) {
  std::mutex mutex;
  std::multiset<std::size_t> begun;
  std::set<std::thread::id> threads;
  on_threads(
      4, 3,
      [&](std::size_t thread) {
        const std::lock_guard lock(mutex);
        begun.insert(thread);
        threads.insert(std::this_thread::get_id());
        return [](std::size_t k) { return k; };
      },
      [](std::size_t, std::size_t) { return true; });
  EXPECT_EQ(begun, std::multiset<std::size_t>({0, 1, 2}));  // no more threads than pieces
  EXPECT_EQ(threads.size(), 3u);
  EXPECT_TRUE(threads.contains(std::this_thread::get_id()));
}

TEST(OnThreads, NoMoreAreBegunOnceEnoughAreTaken) {
  constexpr std::size_t kThreads = 3, kWanted = 10;
  std::atomic<std::size_t> begun = 0;
  std::size_t taken = 0;
  on_threads(
      kThreads, 100000, [&](std::size_t) { return [&](std::size_t) { return ++begun; }; },
      [&](std::size_t, std::size_t) { return ++taken < kWanted; });
  EXPECT_GE(taken, kWanted);
  EXPECT_LT(taken, kWanted + kThreads);  // of each other thread the one that was under way
  EXPECT_LT(begun, 100000u);
}

TEST(OnThreads, WhatIsThrownComesOutAndEndsTheWork) {
  const auto thrown_by = [](std::size_t threads, const auto& begin, const auto& take) {
    try {
      on_threads(threads, 100000, begin, take);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const std::size_t threads : {1u, 4u}) {
    std::size_t taken = 0;
    const auto count = [&](std::size_t, std::size_t) { return ++taken > 0; };
    EXPECT_EQ(thrown_by(
                  threads,
                  [](std::size_t) {
                    return [](std::size_t k) {
                      return k == 7 ? throw std::runtime_error("of a piece") : k;
                    };
                  },
                  count),
              "of a piece");
    if (threads == 1) {
      EXPECT_EQ(taken, 7u);
    }
    const auto refuse = [](std::size_t k, std::size_t) {
      return k == 7 ? throw std::runtime_error("of the taker") : true;
    };
    EXPECT_EQ(thrown_by(threads, square, refuse), "of the taker");
    taken = 0;
    EXPECT_EQ(thrown_by(
                  threads,
                  [](std::size_t thread) {
                    if (thread == 0) throw std::runtime_error("of a beginning");
                    return [](std::size_t k) { return k; };
                  },
                  count),
              "of a beginning");
  }
}

}  // namespace
}  // namespace misalign::search
