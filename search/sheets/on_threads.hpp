// Work in pieces on several threads, taken in by one thread at a time.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace misalign::search {

/// Does pieces 0 to `pieces` - 1, begun in this order, on at most `threads` threads, this one among
/// them. `begin(thread)` is called on each thread, numbered from 0, and returns its worker;
/// `take(k, result)` is called by one thread at a time, and returns false to end the work. The
/// first exception ends the work, and is thrown again once all threads have ended.
template <class Begin, class Take>
void on_threads(std::size_t threads, std::size_t pieces, const Begin& begin, const Take& take) {
  if (pieces == 0) return;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> has_ended = false;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&](std::size_t thread) {
    try {
      const auto do_piece = begin(thread);
      for (std::size_t k; !has_ended && (k = next++) < pieces;) {
        const auto result = do_piece(k);
        const std::lock_guard lock(mutex);
        if (!failure && !take(k, result)) has_ended = true;
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      has_ended = true;
    }
  };
  std::vector<std::thread> others;
  try {
    for (std::size_t k = 1; k < std::min(threads, pieces); ++k) others.emplace_back(work, k);
  } catch (const std::system_error&) {
    // No more threads are to be had: those that there are do it all.
  }
  work(0);
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace misalign::search
