// Taylor models against MPFI, at length (results/certificates/arithmetic.md): at least so many
// operations, how many broke their enclosure, and how much of a radius rounding alone came to use.
//   model_arithmetic OPERATIONS [SEED]
#include <cstdio>
#include <cstdlib>

#include "tests/solver/model_trials.hpp"

int main(int argc, char** argv) {
  using misalign::solver::ModelTrials;
  const long operations = argc > 1 ? std::atol(argv[1]) : 0;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  if (operations < 1) {
    std::fprintf(stderr, "model_arithmetic OPERATIONS [SEED]: OPERATIONS must be 1 or more\n");
    return 2;
  }
  ModelTrials trials(seed);
  do trials.run();
  while (trials.trials() < operations);
  std::printf("| operation | trials | broken | nothing claimed | rounding, of the radius |\n");
  std::printf("|---|---|---|---|---|\n");
  for (const auto& count : trials.counts()) {
    std::printf("| %s | %ld | %ld | %ld | %.2f |\n", count.name.c_str(), count.trials, count.broken,
                count.silent, count.most_of_error);
  }
  std::printf("\n%ld operations, %ld broken, seed %llu\n", trials.trials(), trials.broken(),
              static_cast<unsigned long long>(seed));
  return trials.broken() == 0 ? 0 : 1;
}
