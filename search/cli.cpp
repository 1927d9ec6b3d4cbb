#include "search/cli.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "schema/input.hpp"
#include "search/build_info.hpp"
#include "search/mpi_session.hpp"
#include "search/verbs.hpp"
#include "solver/batch.hpp"

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

void set_up_log(const std::string& level) {
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(
      std::getenv("NO_COLOR") ? spdlog::color_mode::never : spdlog::color_mode::automatic);
  auto logger = std::make_shared<spdlog::logger>("misalign", sink);
  logger->set_pattern("misalign: %^%v%$");
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(logger);
}

// CLI11's sentence with the contract's exit code.
int usage_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
  if (launched_rank() == 0) {
    std::fprintf(stderr, "misalign: %s; see misalign --help, or a verb's own\n", error.what());
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

CLI::Validator one_of(const Names& names, const std::string& where) {
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
      "");
}

int run_command_line(int argc, char** argv) {
  CLI::App app("Searches for misaligned origami that simple springs deploy.", "misalign");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.fallthrough();
  std::string level = "info";
  app.add_option("--log-level", level, "debug, info, warning, error or off [info]")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
  std::map<std::string, Action> verbs = {
      {"search", add_search(app)},       {"status", add_status(app)},
      {"fold", add_fold(app)},           {"perforations", add_perforations(app)},
      {"replay", add_replay(app)},       {"query", add_query(app)},
      {"export", add_export(app)},       {"verify", add_verify(app)},
      {"merge", add_merge(app)},         {"config", add_config(app)},
      {"tolerance", add_tolerance(app)}, {"doctor", add_doctor(app)},
      {"actuators", add_actuators(app)}, {"report", add_report(app)},
      {"bench", add_bench(app)}};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return usage_error(app, error);
  }
  set_up_log(level);
  const auto fail = [](const std::exception& error, int exit_code) {
    if (launched_rank() == 0) spdlog::error("{}", error.what());
    return exit_code;
  };
  try {
    const int exit_code = verbs.at(app.get_subcommands().front()->get_name())();
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
      throw UserError(schema::kExitFailure,
                      "the results could not be written to standard output (is the disk full?)");
    }
    return exit_code;
  } catch (const UserError& error) {
    return fail(error, error.exit_code());
  } catch (const std::exception& error) {
    return fail(error, schema::kExitFailure);
  }
}

}  // namespace misalign::search
