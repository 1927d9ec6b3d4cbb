#include "search/ranks/process_start.hpp"
#include "search/verbs/cli.hpp"

int main(int argc, char** argv) {
  misalign::search::prepare_process();
  return misalign::search::run_command_line(argc, argv);
}
