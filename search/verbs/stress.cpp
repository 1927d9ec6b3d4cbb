// `misalign stress`: the deployment of elastic panels, by CalculiX.
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

#include "schema/catalogue/study_table.hpp"
#include "schema/exchange/stress_json.hpp"
#include "schema/files/output_file.hpp"
#include "search/ranks/departure.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/sheets/calculix_run.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/export_files.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/duration.hpp"
#include "search/terminal/screen.hpp"
#include "search/terminal/stopwatch.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using solver::StressStudy;

struct StressCall : SheetCall {
  ReleaseCall release;
  DeckCall deck;
  StressStudyOptions options;
  std::string directory;
};

// "miura-6x6-1234", or a pattern file's name, as ccx takes it.
std::string job_of(const StressCall& call, const ChosenSheet& sheet) {
  std::string job = sheet.drawn ? sheet.drawn->campaign.name + "-" + sheet.key().name().substr(5)
                                : std::filesystem::path(call.path).stem().string();
  constexpr std::size_t kLongest = 60;  // ccx takes names of 132 characters, their directory among
  if (job.size() > kLongest) job.resize(kLongest);
  for (char& c : job) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 128 || !(std::isalnum(byte) || c == '-' || c == '_')) c = '_';
  }
  return job;
}

// Refuses an input that the run would replace or remove.
void keep_input(const StressCall& call, const std::string& job) {
  const auto check = [&](const char* ending) {
    std::error_code error;
    if (!std::filesystem::equivalent(job_file(call.directory, job, ending), call.path, error)) {
      return;
    }
    throw schema::UserError(schema::Cause::bad_request,
                            "--output " + call.directory +
                                ": a file would replace the one that is read (it has the same "
                                "name); name another directory");
  };
  std::for_each(std::begin(kJobEndings), std::end(kJobEndings), check);
  check("-stress.json");
  const std::string result = job_file(call.directory, job, "-stress.json");
  std::error_code ignored;
  if (std::filesystem::is_symlink(result, ignored)) {
    throw schema::UserError(schema::Cause::bad_request,
                            result +
                                ": is a link, which is not followed (its name was not typed); "
                                "remove it, or name another directory");
  }
}

// Shows progress: a live line on a terminal, else a line now and then.
class StressProgress {
 public:
  explicit StressProgress(double end_s)
      : end_s_(end_s), live_(is_terminal(STDERR_FILENO) && terminal_is_able()) {}
  ~StressProgress() {
    if (live_) erase_live_line();
  }
  StressProgress(const StressProgress&) = delete;
  StressProgress& operator=(const StressProgress&) = delete;

  void show(const StressStudy::Row& row) {
    std::string line =
        fmt::format("{:.4f} s of at most {:g} s: pilot at {:.2f} deg, creases within {:.2f} deg",
                    row.time_s, end_s_, row.pilot_deg, row.widest_deg);
    if (row.time_s > 0) {
      const double left_s = watch_.seconds() * (end_s_ - row.time_s) / row.time_s;
      line += ", " + duration(left_s) + " left at most";
    }
    if (live_) {
      draw_live_line(line);
    } else if (watch_.seconds() >= next_s_) {
      std::fprintf(stderr, "%s\n", line.c_str());
      constexpr double kBetweenLines_s = 30;
      next_s_ = watch_.seconds() + kBetweenLines_s;
    }
  }

 private:
  const double end_s_;
  const bool live_;
  Stopwatch watch_;
  double next_s_ = 10;
};

// The motion of rigid panels, the limit of stiff panels.
std::vector<solver::Deployment::Row> rigid_motion(const solver::Sheet& sheet,
                                                  const schema::SimulatedSheet& released) {
  solver::ReleaseOptions options;
  options.from_deg = released.pilot_deg;
  options.sheet.fill = solver::Springs{.stiffness_n_per_mm = released.stiffness_n_per_mm,
                                       .rest_deg = released.rest_deg};
  options.sheet.plates = released.plates;
  return deployed(sheet, options).run.rows;
}

void show_stress(StressCall& call) {
  read_material(call.deck.material, call.release.design);
  const auto& [chosen, model, sheet] = choose_sheet(call.path, call.draw, call.release.design);
  const schema::DeckOptions deck = call.deck.of(model.design());
  call.options.deck.elements = deck.elements;
  call.options.deck.material = deck.material;
  const SimulationStart how = call.release.of(model.design());
  const schema::SimulatedSheet released = release(model, sheet, how, "misalign: " + chosen.name());
  warn_beyond_d(sheet, how.from_deg);
  if (released.rest_deg > 0) call.options.flat_deg = 0;
  find_calculix();
  make_directory(call.directory);
  const std::string job = job_of(call, chosen);
  keep_input(call, job);
  const std::string result = job_file(call.directory, job, "-stress.json");
  solver::StressStudy study;
  {
    // The results so far are read and written within this time, or the program ends anyway.
    constexpr double kToReadAndWrite_s = 120;
    watch_for_signals();
    const Departure departure(kToReadAndWrite_s, LeftFrom::anywhere, [] {
      spdlog::error("stopped before what CalculiX reached was read; ask it for less at once");
      return exit_code_of(schema::Cause::failure);
    });
    StressProgress progress(call.options.deck.end_s);
    study =
        study_stress(released, call.options, call.directory, job, [&](const StressStudy::Row& row) {
          progress.show(row);
          return stop_request() == StopRequest::none;
        });
  }
  study.rigid = rigid_motion(sheet, released);
  schema::Json json =
      schema::stress_json(released, call.options.deck, call.options.stress.disc_mm, study);
  json.update(chosen.whose());
  schema::write_text_file(result, json.dump(1) + "\n");
  if (call.json) return put_json(json);
  put("{}: released from {}\n{}\n", sheet.name(), stress_text(released, call.options, study),
      schema::printable(result));
}

constexpr const char* kStressFooter =
    "The sheet is folded without stress to --from and released free in space, with springs on\n"
    "its diagonals. Panels are elastic shells with large deflections and creases turn freely.\n"
    "Only --damping and, a little, the integrator damp the motion. rigid_deg is the pilot angle\n"
    "of rigid panels without damping, as in `misalign deploy`. The run ends when the sheet is\n"
    "deployed (every crease within 5 deg at one moment) or at --time-limit; with --rest-deg only\n"
    "there.\n"
    "Springs and ball joints pull at points, where stress grows without bound as meshes get\n"
    "finer: what counts is the largest von Mises stress outside discs round every vertex.\n"
    "The directory keeps the deck (.inp), the files of ccx, and NAME-stress.json, which\n"
    "`misalign report --stress` shows. While it runs all that is in a subdirectory,\n"
    "NAME.run-XXXXXX. Ctrl-C and SIGTERM end ccx; what it has reached is kept and shown. ccx is\n"
    "the first one in PATH, and uses as many cores as OMP_NUM_THREADS says.\n"
    "Examples:\n"
    "  misalign stress search/patterns/table1.json --output stress\n"
    "  misalign stress results/miura-6x6-1a2b3c4d.db 1234 --from 90 --mesh 4 --output stress\n"
    "  misalign stress search/patterns/table1.json --material steel.json --thickness 0.5 \\\n"
    "    --output stress";

}  // namespace

Action stress_verb(CLI::App& verb) {
  verb.description(schema::study_named("stress").about);
  verb.footer(kStressFooter);
  auto call = std::make_shared<StressCall>();
  add_sheet(verb, *call);
  add_stiffness(verb, call->release.design.stiffness_n_per_mm);
  add_preload(verb, call->release.design.preload_n);
  add_release(verb, call->release);
  add_deck(verb, call->deck);
  StressStudyOptions& options = call->options;
  add_default(verb, "--time-limit", options.deck.end_s, "longest time of the motion, s",
              within(1e-6, 1e6), "S");
  add_default(verb, "--time-step", options.deck.time_step_s, "longest increment, s",
              within(1e-9, 1), "S");
  add_default(verb, "--damping", options.deck.damping_per_s, "mass-proportional damping, 1/s",
              within(0, 1e6), "PER_S");
  add_default(verb, "--disc", options.stress.disc_mm, "radius of the discs, mm", within(0, 1e6),
              "MM");
  verb.add_option("--output", call->directory, "directory, made if it is not there")
      ->required()
      ->type_name("DIR");
  verb.add_flag("--json", call->json, "as JSON, with all histories");
  return showing(call, show_stress);
}

}  // namespace misalign::search
