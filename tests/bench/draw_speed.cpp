// draw_speed CAMPAIGN search|paths DRAWS: CPU seconds that the draws from 0 on take, as a search
// evaluates them (all but the catalogue) or each on its full path: what results/python/ compares
// Python with.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "tests/bench/cpu_seconds.hpp"

using namespace misalign;

int main(int count, char** arguments) {
  if (count != 4) return 2;
  search::DrawEvaluator evaluator(schema::read_campaign_file(arguments[1]));
  const std::uint64_t draws = std::strtoull(arguments[3], nullptr, 10);
  // Its tables are made with the first draws.
  search::work_off(evaluator, {0, 16});
  const double start_s = bench::cpu_seconds();
  if (std::string(arguments[2]) == "search") {
    search::work_off(evaluator, {0, draws});
  } else {
    for (std::uint64_t lo = 0; lo < draws; lo += 256) {
      evaluator.judge({lo, std::min(lo + 256, draws)});
    }
  }
  std::printf("%.6f\n", bench::cpu_seconds() - start_s);
}
