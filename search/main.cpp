#include "search/sheets/whole_program.hpp"
#include "search/verbs/cli.hpp"

int main(int argc, char** argv) {
  using namespace misalign::search;
  return run_command_line(argc, argv, kWholeProgram, all_verbs);
}
