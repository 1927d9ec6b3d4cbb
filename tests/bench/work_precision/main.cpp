// Time per path against the largest error of any diagonal, method by method; with --mesh, cost
// against the size of the sheet. CSV on standard output.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/bench/work_precision/mesh.hpp"
#include "tests/bench/work_precision/study.hpp"

int main(int argc, char** argv) {
  bool mesh = false;
  int sheets = 32, repeats = 5;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--mesh") == 0) {
      mesh = true;
    } else if (std::strcmp(argv[i], "--sheets") == 0 && i + 1 < argc) {
      sheets = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--repeats") == 0 && i + 1 < argc) {
      repeats = std::atoi(argv[++i]);
    } else {
      std::fprintf(stderr, "usage: work_precision [--mesh] [--sheets N] [--repeats N]\n");
      return 2;
    }
  }
  if (sheets < 1 || repeats < 1) {
    std::fprintf(stderr, "--sheets and --repeats must be at least 1\n");
    return 2;
  }
  if (mesh) {
    misalign::bench::measure_mesh(repeats);
  } else {
    misalign::bench::measure_methods(sheets, repeats);
  }
}
