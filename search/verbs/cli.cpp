#include "search/verbs/cli.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sqlite3.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <optional>
#include <thread>

#include "schema/files/features.hpp"
#include "schema/files/input.hpp"
#include "schema/files/kept_inputs.hpp"
#include "search/ranks/mpi_session.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/terminal/build_info.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/process_start.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/help_format.hpp"
#include "search/verbs/log.hpp"
#include "search/verbs/usage.hpp"
#include "search/verbs/validators.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {
namespace {

std::string version_text() {
  const BuildInfo& build = build_info();
  return fmt::format(
      "misalign {}\ncommit    {}\ncompiler  {}\nflags     {}\n"
      "libraries Eigen {}.{}.{}, SQLite {}, nlohmann-json {}.{}.{}\nwith      {}\nwithout   {}\n"
      "instruction set {}",
      build.version, build.commit, build.compiler, build.flags, EIGEN_WORLD_VERSION,
      EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, sqlite3_libversion(), NLOHMANN_JSON_VERSION_MAJOR,
      NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH, schema::libraries_text(true),
      schema::libraries_text(false),
      solver::instruction_set_name(solver::available_instruction_sets().back()));
}

// Returns whether rank 0 of the same run prints the sentence. Every other verb prints its own, as
// its shell may have been started by a launcher and inherited a rank's number.
bool rank_zero_speaks(const CLI::App& app) {
  const CLI::App* const verb = chosen_verb(app);
  return verb && (verb->get_name() == "search" || verb->get_name() == "certify") &&
         launched_rank() != 0;
}

// A launcher ends every rank as soon as one exits with an error: rank 0 too, which on a busy
// machine may not have printed yet. So the others wait to be ended. After this time rank 0 has no
// error of its own, as where the disk failed for one of them, and they speak themselves.
void wait_to_be_ended() { std::this_thread::sleep_for(std::chrono::seconds(10)); }

// Standard output may not have been written.
int exit_code_once_written(int exit_code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return exit_code;
  if (reader_has_gone()) return 128 + SIGPIPE;  // no alarm: as if that signal had ended it
  std::fputs(
      "misalign: the results could not be written to standard output (is the disk full, or was it "
      "closed?); check where it goes, and repeat the command\n",
      stderr);
  return exit_code_of(schema::Cause::failure);
}

// Prints the sentence and the help to read; returns the contract's exit code.
int usage_error(const CLI::App& app, const CLI::ParseError& error, const Words& words) {
  if (error.get_exit_code() == 0) return exit_code_once_written(app.exit(error));  // --help
  if (rank_zero_speaks(app)) wait_to_be_ended();
  if (words.empty()) {
    std::fputs(app.help().c_str(), stderr);
  } else {
    const CLI::App* const verb = chosen_verb(app);
    std::string sentence = verb ? too_many_files(*verb, words) : "";
    if (sentence.empty()) sentence = usage_sentence(app, words, error.what());
    sentence = schema::shortened(schema::printable(sentence), 1000);
    std::fprintf(stderr, "misalign: %s; see misalign %s--help\n", sentence.c_str(),
                 verb ? (verb->get_name() + " ").c_str() : "");
  }
  return exit_code_of(schema::Cause::bad_request);
}

// Returns whether a verb shows its progress itself, or has no end.
bool shows_itself(const std::string& verb) {
  return verb == "search" || verb == "certify" || verb == "stress" || verb == "watch";
}

}  // namespace

int run_command_line(int argc, char** argv, const Parts& parts,
                     std::vector<Verb> (*verbs)(const Words&, const Parts&)) {
  prepare_process();
  watch_for_lost_pages();
  CLI::App app("Searches for misaligned origami that simple springs deploy.", "misalign");
  app.set_version_flag("--version", version_text(),
                       "print version, commit, compiler and libraries, and exit");
  app.require_subcommand(1);
  app.fallthrough();
  app.formatter(std::make_shared<HelpFormat>());
  app.set_help_flag("-h,--help", "print this help and exit");
  app.footer(
      "See misalign VERB --help for the options of a verb, with examples.\n\n"
      "Examples:\n"
      "  misalign search search/campaigns/miura-4x4.json --draws 2000\n"
      "  misalign query results/miura-4x4-*.db best\n"
      "  misalign fold search/patterns/table1.json");
  std::string level = "info";
  auto color = ColorMode::automatic;
  app.add_option("--log-level", level, "lowest level of messages to show [info]")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
  app.add_option("--color", color,
                 "when to color; auto: on terminals, unless NO_COLOR is set [auto]")
      ->transform(one_of<ColorMode>({{"auto", ColorMode::automatic},
                                     {"always", ColorMode::always},
                                     {"never", ColorMode::never}}));
  const Words typed(argv, argv + argc);
  std::map<const CLI::App*, Action> actions;
  for (const Verb& each : verbs(typed, parts)) {
    CLI::App* verb = app.add_subcommand(each.name);
    actions[verb] = each.set_up(*verb);
  }
  const Words words(argv + std::min(argc, 1), argv + argc);
  try {
    app.parse(argc, argv);
    std::string sentence = too_many_files(*chosen_verb(app), words);
    if (sentence.empty()) sentence = output_among_inputs(*chosen_verb(app));
    if (!sentence.empty())
      throw CLI::ParseError(sentence, exit_code_of(schema::Cause::bad_request));
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, words);
  }
  schema::keep_inputs();
  set_color_mode(color);
  set_up_log(level, color);
  try {
    std::optional<LongWork> work;
    const std::string verb = chosen_verb(app)->get_name();
    if (!shows_itself(verb)) work.emplace(verb + " is under way", work_style(), level == "debug");
    const int exit_code = actions.at(chosen_verb(app))();
    work.reset();
    return exit_code_once_written(exit_code);
  } catch (const std::exception& error) {
    const schema::UserError failure = failure_of(error);
    const int exit_code = exit_code_of(failure.cause());
    if (rank_zero_speaks(app)) wait_to_be_ended();
    spdlog::error("{}", sentence_as_given(*chosen_verb(app), failure));
    return exit_code;
  }
}

}  // namespace misalign::search
