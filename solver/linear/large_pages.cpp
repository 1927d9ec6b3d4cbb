#include "solver/linear/large_pages.hpp"

#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace misalign::solver {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20, kRegister = 64;

}  // namespace

void* allocate_in_large_pages(std::size_t bytes) {
  const bool is_large = bytes >= kLargePage;
  const std::size_t alignment = is_large ? kLargePage : kRegister;
  void* const memory =
      std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (is_large) madvise(memory, bytes, MADV_HUGEPAGE);  // advice only: without it access is slower
#endif
  return memory;
}

void free_large_pages(void* memory) { std::free(memory); }

}  // namespace misalign::solver
