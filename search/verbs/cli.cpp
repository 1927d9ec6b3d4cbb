#include "search/verbs/cli.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sqlite3.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <thread>

#include "schema/campaign/draw_range.hpp"
#include "schema/files/input.hpp"
#include "search/ranks/build_info.hpp"
#include "search/ranks/mpi_session.hpp"
#include "search/terminal/failure.hpp"
#include "search/terminal/help_format.hpp"
#include "search/terminal/progress.hpp"
#include "search/terminal/suggestion.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/verbs.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {
namespace {

using schema::UserError;

std::string version_text() {
  const BuildInfo& build = build_info();
  return "misalign " + build.version + "\ncommit    " + build.commit + "\ncompiler  " +
         build.compiler + "\nflags     " + build.flags + "\nlibraries Eigen " +
         std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION) + ", SQLite " + sqlite3_libversion() +
         ", nlohmann-json " + std::to_string(NLOHMANN_JSON_VERSION_MAJOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_MINOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_PATCH) + "\ninstruction set " +
         solver::instruction_set_name(solver::available_instruction_sets().back());
}

// Messages stand on lines of their own, not behind a live one.
using ColorSink = spdlog::sinks::stderr_color_sink_mt;
class MessageSink : public ColorSink {
 public:
  explicit MessageSink(spdlog::color_mode mode) : ColorSink(mode) {}
  void log(const spdlog::details::log_msg& message) override {
    erase_live_line();
    const std::string_view said(message.payload.data(), message.payload.size());
    const std::string shown = on_lines_of_its_own(said);
    spdlog::details::log_msg printable = message;
    printable.payload = shown;
    ColorSink::log(printable);
  }

 private:
  // Names and values in it may come from anywhere; what is behind a line feed is never taken for a
  // message of its own.
  static std::string on_lines_of_its_own(std::string_view said) {
    std::string shown;
    for (std::size_t begin = 0; begin <= said.size();) {
      const std::size_t end = std::min(said.find('\n', begin), said.size());
      const std::string_view line = said.substr(begin, end - begin);
      if (begin > 0) shown += line.starts_with("  ") ? "\n" : "\n  ";
      shown += schema::printable(line);
      begin = end + 1;
    }
    return shown;
  }
};

void set_up_log(const std::string& level, ColorWish color) {
  auto sink = std::make_shared<MessageSink>(colors_wanted(color, is_terminal(STDERR_FILENO))
                                                ? spdlog::color_mode::always
                                                : spdlog::color_mode::never);
  sink->set_color(spdlog::level::info, "");
  auto logger = std::make_shared<spdlog::logger>("misalign", sink);
  logger->set_pattern("misalign: %^%v%$");
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(logger);
}

const CLI::App* chosen_verb(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? nullptr : chosen.front();
}

// Words that are neither a verb's options nor their values, as the shell gave them.
std::vector<std::string> arguments_of(const CLI::App& verb, const std::vector<std::string>& words) {
  std::vector<std::string> arguments;
  bool only_arguments = false;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string& word = words[k];
    if (only_arguments || word.size() < 2 || word[0] != '-') {
      arguments.push_back(word);
    } else if (word == "--") {
      only_arguments = true;
    } else if (takes_next_word(verb, word)) {
      ++k;
    }
  }
  if (!arguments.empty()) arguments.erase(arguments.begin());  // the verb's name
  return arguments;
}

// A pattern of the shell's, such as results/miura-*.db, that matches more files than the verb takes
// would give the second one to the next argument. Empty if there is nothing to say.
std::string too_many_files(const CLI::App& verb, const std::vector<std::string>& words) {
  for (const CLI::Option* argument : positionals_of(verb)) {
    const bool takes_draws = argument->get_name(/*positional=*/true) == "DRAW";
    if (takes_many(*argument) && !takes_draws) return "";
  }
  const std::vector<std::string> arguments = arguments_of(verb, words);
  const auto is_like_first = [&](const std::string& word) {
    const std::filesystem::path path(word), first(arguments.front());
    std::error_code ignored;
    return path.has_extension() && path.extension() == first.extension() &&
           std::filesystem::is_regular_file(path, ignored);
  };
  std::string names;
  int files = 0;
  constexpr int kShown = 4;
  for (const std::string& word : arguments) {
    if (!is_like_first(word)) continue;
    if (++files <= kShown) names += (files > 1 ? ", " : "") + word;
  }
  if (files < 2) return "";
  return (files == 2 ? "two" : std::to_string(files)) + " files match (" + names +
         (files > kShown ? ", ..." : "") + ") and " + verb.get_name() + " takes one; name one";
}

// What was typed and is unknown, and what may have been meant; else CLI11's sentence.
std::string usage_sentence(const CLI::App& app, const std::string& otherwise) {
  const CLI::App* const verb = chosen_verb(app);
  for (const std::string& word : app.remaining(/*recurse=*/true)) {
    const bool is_option = word.size() > 1 && word[0] == '-';
    if (!is_option && verb) {
      return verb->get_name() + " takes no further argument, such as " + word;
    }
    std::vector<std::string> known;
    if (is_option) {
      for (const CLI::Option* option : options_of(verb ? *verb : app)) {
        for (const std::string& name : names_of(*option)) known.push_back(name);
      }
    } else {
      for (const CLI::App* each : verbs_of(app)) known.push_back(each->get_name());
    }
    return unknown_word(word.substr(0, word.find('=')),
                        !is_option ? "verb" : "option" + (verb ? " of " + verb->get_name() : ""),
                        known);
  }
  return verb ? otherwise : "a verb is missing";
}

// Whether another rank of the same search says what there is to say. Every other verb speaks,
// though its shell may have been started by a launcher and inherited a rank's number.
bool rank_zero_speaks(const CLI::App& app) {
  const CLI::App* const verb = chosen_verb(app);
  return verb && verb->get_name() == "search" && launched_rank() != 0;
}

// A launcher ends every rank as soon as one exits with an error: rank 0 too, which on a busy
// machine may not have spoken yet. So the others wait to be ended, and after this long leave by
// themselves.
int leave_it_to_rank_zero(int exit_code) {
  std::this_thread::sleep_for(std::chrono::seconds(10));
  return exit_code;
}

// The contract's exit code, and where to read on.
int usage_error(const CLI::App& app, const CLI::ParseError& error,
                const std::vector<std::string>& words) {
  if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
  if (rank_zero_speaks(app)) return leave_it_to_rank_zero(schema::kExitUsage);
  if (words.empty()) {
    std::fputs(app.help().c_str(), stderr);
  } else {
    const CLI::App* const verb = chosen_verb(app);
    std::string sentence = verb ? too_many_files(*verb, words) : "";
    if (sentence.empty()) sentence = usage_sentence(app, error.what());
    sentence = schema::shortened(schema::printable(sentence), 1000);
    std::fprintf(stderr, "misalign: %s; see misalign %s--help\n", sentence.c_str(),
                 verb ? (verb->get_name() + " ").c_str() : "");
  }
  return schema::kExitUsage;
}

}  // namespace

CLI::Validator within(double least, double most) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return "";
        return text + " is not a number from " + schema::shown_number(least) + " to " +
               schema::shown_number(most);
      },
      "");
}

namespace {

// A share that was written as percent.
std::string share_meant(double value, double least, double most) {
  const double meant = value / 100;
  if (value <= most || meant < least || meant > most) return "";
  return " (a share, not percent; did you mean " + schema::shown_number(meant) + "?)";
}

// As --help and completion want it: {auto,plain}.
std::string shown_set(const std::vector<std::string>& names) {
  std::string set;
  for (const std::string& name : names) set += (set.empty() ? "{" : ",") + name;
  return set + "}";
}

}  // namespace

CLI::Validator a_share(double least, double most) {
  const CLI::Validator number = within(least, most);
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const std::string fault = number(text);
        double value = 0;
        if (fault.empty() || !CLI::detail::lexical_cast(text, value)) return fault;
        return fault + share_meant(value, least, most);
      },
      "");
}

CLI::Validator counted(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc{} && stop == text.data() + text.size();
        if (whole && value >= least && value <= most) return "";
        return text + " is not a whole number from " + std::to_string(least) + " to " +
               std::to_string(most) + ", written with digits alone";
      },
      "");
}

CLI::Validator a_draw() { return counted(0, schema::kEndOfDraws); }

CLI::Validator one_of(const Names& names, const std::string& where) {
  std::vector<std::string> typed;
  for (const auto& [name, value] : names) typed.push_back(name);
  return CLI::Validator(
      [=](std::string& text) {
        std::string all;
        for (const auto& [name, value] : names) {
          if (text == name) {
            text = value;
            return std::string();
          }
          all += (all.empty() ? "" : ", ") + name;
        }
        return "'" + text + "' is none of " + all + where;
      },
      shown_set(typed));
}

CLI::Validator known_word(const std::string& kind, const std::vector<std::string>& known) {
  return CLI::Validator(
      [=](const std::string& text) {
        const bool is_known = std::find(known.begin(), known.end(), text) != known.end();
        return is_known ? std::string() : unknown_word(text, kind, known);
      },
      shown_set(known));
}

int run_command_line(int argc, char** argv) {
  CLI::App app("Searches for misaligned origami that simple springs deploy.", "misalign");
  app.set_version_flag("--version", version_text(),
                       "print version, commit, compiler, libraries and end");
  app.require_subcommand(1);
  app.fallthrough();
  app.formatter(std::make_shared<HelpFormat>());
  app.set_help_flag("-h,--help", "print this and end");
  app.footer(
      "See misalign VERB --help for the options of a verb, with examples.\n\n"
      "Examples:\n"
      "  misalign search search/campaigns/miura-4x4.json --draws 2000\n"
      "  misalign query results/miura-4x4-*.db best\n"
      "  misalign fold search/patterns/table1.json");
  std::string level = "info";
  auto color = ColorWish::automatic;
  app.add_option("--log-level", level, "least important messages to show [info]")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
  app.add_option("--color", color,
                 "when to color; auto: on terminals, unless NO_COLOR is set [auto]")
      ->transform(one_of({{"auto", number_of(ColorWish::automatic)},
                          {"always", number_of(ColorWish::always)},
                          {"never", number_of(ColorWish::never)}}));
  std::map<std::string, Action> verbs = {{"search", add_search(app, {argv, argv + argc})},
                                         {"status", add_status(app)},
                                         {"fold", add_fold(app)},
                                         {"perforations", add_perforations(app)},
                                         {"replay", add_replay(app)},
                                         {"query", add_query(app)},
                                         {"export", add_export(app)},
                                         {"verify", add_verify(app)},
                                         {"merge", add_merge(app)},
                                         {"config", add_config(app)},
                                         {"tolerance", add_tolerance(app)},
                                         {"doctor", add_doctor(app)},
                                         {"actuators", add_actuators(app)},
                                         {"report", add_report(app)},
                                         {"bench", add_bench(app)},
                                         {"completion", add_completion(app)},
                                         {"help", add_help(app)}};
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  try {
    app.parse(argc, argv);
    const std::string sentence = too_many_files(*chosen_verb(app), words);
    if (!sentence.empty()) throw CLI::ParseError(sentence, schema::kExitUsage);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error, words);
  }
  wish_colors(color);
  set_up_log(level, color);
  try {
    const int exit_code = verbs.at(app.get_subcommands().front()->get_name())();
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
      if (reader_has_gone()) return 128 + SIGPIPE;  // no alarm: as if that signal had ended it
      throw UserError(schema::kExitFailure,
                      "the results could not be written to standard output (is the disk full?)");
    }
    return exit_code;
  } catch (const std::exception& error) {
    const Failure failure = failure_of(error);
    if (rank_zero_speaks(app)) return leave_it_to_rank_zero(failure.exit_code);
    spdlog::error("{}", failure.sentence);
    return failure.exit_code;
  }
}

}  // namespace misalign::search
