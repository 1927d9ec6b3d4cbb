#include "search/ranks/process_start.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/verbs/cli.hpp"

int main(int argc, char** argv) {
  misalign::search::prepare_process();
  misalign::search::watch_for_lost_pages();
  return misalign::search::run_command_line(argc, argv, misalign::search::all_verbs);
}
