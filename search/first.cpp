// Starts half of the program: search, status and query, without what needs proofs or a sheet in
// motion.
#include "search/verbs/cli.hpp"

int main(int argc, char** argv) {
  using namespace misalign::search;
  return run_command_line(argc, argv, {}, first_verbs);
}
