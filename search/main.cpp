#include "search/cli.hpp"

int main(int argc, char** argv) { return misalign::search::run_command_line(argc, argv); }
