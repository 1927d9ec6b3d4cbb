// `misalign stress`: the deployment of elastic panels, by CalculiX.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

#include "schema/files/text_file.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/deployer.hpp"
#include "search/sheets/sheet_files.hpp"
#include "search/sheets/stress_study.hpp"
#include "search/terminal/duration.hpp"
#include "search/terminal/progress.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using schema::ElasticRow;

struct StressCall {
  std::string path;                   // a catalogue or a pattern file
  std::optional<std::uint64_t> draw;  // of a catalogue's campaign, accepted or not
  OtherActuators actuators;
  ReleaseCall release;
  DeckCall deck;
  StressStudyOptions options;
  std::string directory;
  bool json = false;
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

// What the run writes, and what it removes first, must not be what is read.
void keep_input(const StressCall& call, const std::string& job) {
  const auto check = [&](const char* ending) {
    std::error_code error;
    if (!std::filesystem::equivalent(job_file(call.directory, job, ending), call.path, error)) {
      return;
    }
    throw schema::UserError(schema::kExitUsage,
                            "--output " + call.directory +
                                ": a file would replace the one that is read (it has the same "
                                "name); name another directory");
  };
  std::for_each(std::begin(kJobEndings), std::end(kJobEndings), check);
  check("-stress.json");
}

// How far it is: a live line where somebody watches, else a line now and then.
class StressProgress {
 public:
  explicit StressProgress(double end_s)
      : end_s_(end_s), live_(is_terminal(STDERR_FILENO) && terminal_is_able()) {}
  ~StressProgress() {
    if (live_) erase_live_line();
  }
  StressProgress(const StressProgress&) = delete;
  StressProgress& operator=(const StressProgress&) = delete;

  void show(const ElasticRow& row) {
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

void print_stress(const char* where, const schema::SimulatedSheet& sheet,
                  const std::optional<schema::StressAt>& at) {
  if (!at) return put("  {}: no node lies there; take a finer --mesh\n", where);
  const auto [row, column] = sheet.places[static_cast<std::size_t>(at->panel)];
  put("  {}: {:.3g} MPa after {:.4f} s, in panel [{}, {}] at ({:.1f}, {:.1f}) mm of the flat "
      "sheet\n",
      where, at->stress_mpa, at->time_s, row, column, at->flat_mm.x(), at->flat_mm.y());
}

void print_study(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                 const StressStudy& study) {
  const ElasticRow& last = study.rows.back();
  const schema::Material& material = options.deck.material;
  put("{:g} deg, {} x {} elements a panel of {} ({:g} GPa, {:g} mm), springs of {:g} N/mm\n",
      sheet.pilot_deg, options.deck.elements, options.deck.elements,
      schema::printable(material.name), material.e_gpa, sheet.plates.thickness_mm,
      sheet.stiffness_n_per_mm);
  if (study.deployed_s) {
    put("deployed: every crease within {:g} deg after {:.4f} s\n", options.flat_deg,
        *study.deployed_s);
  } else {
    const std::string where =
        sheet.rest_deg > 0
            ? fmt::format(
                  "springs are relaxed at {:g} deg: after {:.4f} s the pilot "
                  "is at {:.3f} deg",
                  sheet.rest_deg, last.time_s, last.pilot_deg)
            : fmt::format("not deployed: after {:.4f} s creases are within {:.2f} deg", last.time_s,
                          last.widest_deg);
    put("{}{}\n", where,
        study.was_stopped ? "; there it was stopped"
        : study.gave_up   ? "; there ccx gave up"
                          : "");
  }
  put("largest von Mises stress\n");
  print_stress(
      fmt::format("outside discs of {:g} mm round every vertex", options.stress.disc_mm).c_str(),
      sheet, study.stress.outside);
  print_stress("anywhere, which grows as meshes get finer", sheet, study.stress.anywhere);
  put("CalculiX: {} increments, {:.0f} CPU s, {:.0f} MB\n", study.rows.size() - 1,
      study.calculix.cpu_s, study.calculix.memory_mb);
}

// At most twenty rows, the last among them; stresses are the largest since the row before.
void print_way(const StressStudy& study) {
  put("\n   time_s pilot_deg rigid_deg widest_deg springs_n_mm bending_n_mm kinetic_n_mm "
      "outside_discs_mpa\n");
  constexpr std::size_t kRows = 20;
  const std::size_t count = study.rows.size(), every = (count + kRows - 1) / kRows;
  std::size_t frame = 0;
  for (std::size_t k = (count - 1) % every; k < count; k += every) {
    const ElasticRow& row = study.rows[k];
    double largest_mpa = 0;
    for (; frame < study.stress.time_s.size() &&
           study.stress.time_s[frame] <= row.time_s * (1 + 1e-5);
         ++frame) {
      largest_mpa = std::max(largest_mpa, study.stress.outside_mpa[frame]);
    }
    const std::optional<double> rigid_deg = study.rigid_pilot_deg(row.time_s);
    put("{:>9.5f} {:>9.3f} {:>9} {:>10.3f} {:>12.5g} {:>12.5g} {:>12.5g} {:>17.4g}\n", row.time_s,
        row.pilot_deg, rigid_deg ? fmt::format("{:.3f}", *rigid_deg) : "-", row.widest_deg,
        row.springs_n_mm, row.strain_n_mm, row.kinetic_n_mm, largest_mpa);
  }
}

// With rigid panels; it is the way that the motion tends to as panels get stiffer.
std::vector<solver::DeploymentRow> rigid_motion(const ChosenSheet& sheet,
                                                const schema::SimulatedSheet& released) {
  DeployWish wish;
  wish.from_deg = released.pilot_deg;
  wish.stiffness_n_per_mm = released.stiffness_n_per_mm;
  wish.sheet.springs.rest_deg = released.rest_deg;
  wish.sheet.plates = released.plates;
  Deployer deployer(sheet.base, sheet.sampling, sheet.actuators, wish);
  return deployer.study(sheet.shifts_mm, released.pilot_deg, schema::printable(sheet.name()))
      .run.rows;
}

void show_stress(StressCall& call) {
  read_material(call.release, call.deck);
  call.options.deck.elements = call.deck.deck.elements;
  call.options.deck.material = call.deck.deck.material;
  const ChosenSheet sheet = choose_sheet(call.path, call.draw);
  const SheetFolder folder(sheet.base, sheet.sampling, call.actuators.instead_of(sheet.actuators));
  const schema::SimulatedSheet released =
      release(folder, folder.fold(sheet.shifts_mm), call.release.release,
              "misalign: " + sheet.name(), schema::printable(sheet.name()));
  if (released.rest_deg > 0) call.options.flat_deg = 0;
  find_calculix();
  make_directory(call.directory);
  const std::string job = job_of(call, sheet);
  keep_input(call, job);
  const std::string result = job_file(call.directory, job, "-stress.json");
  StressStudy study;
  {
    // What was reached is read and written within that time, or the program ends anyway.
    constexpr double kToReadAndWrite_s = 120;
    watch_for_signals(kToReadAndWrite_s, schema::kExitFailure);
    StressProgress progress(call.options.deck.end_s);
    study = study_stress(released, call.options, call.directory, job, [&](const ElasticRow& row) {
      progress.show(row);
      return stop_request() == StopRequest::none;
    });
  }
  study.rigid = rigid_motion(sheet, released);
  schema::Json json = stress_json(released, call.options, study);
  json.update(sheet.whose());
  schema::write_text_file(result, json.dump(1) + "\n");
  if (call.json) return put_json(json);
  put("{}: let go from ", schema::printable(sheet.name()));
  print_study(released, call.options, study);
  print_way(study);
  put("\n{}\n", schema::printable(result));
}

constexpr const char* kStressFooter =
    "The sheet is folded, without stress, to --from, springs are put on its diagonals, and it is\n"
    "let go, free in space. Panels are elastic shells that bend as far as they like, creases turn\n"
    "freely, and nothing damps but --damping and, a little, the integrator. rigid_deg is the\n"
    "pilot's angle if panels were rigid and nothing damped, as `misalign deploy` has it. The run\n"
    "ends when the sheet is deployed (every crease within 5 deg at one moment) or at "
    "--time-limit;\n"
    "with --rest-deg only there.\n"
    "Springs and ball joints pull at points, where stress has no limit as meshes get finer: what\n"
    "counts is the largest von Mises stress outside discs round every vertex.\n"
    "The directory keeps the deck (.inp), what ccx wrote, and NAME-stress.json, which `misalign\n"
    "report --stress` shows. While it runs all that is in a directory of its own in there,\n"
    "NAME.run-XXXXXX. Ctrl-C and SIGTERM end ccx, and what it has reached is kept and shown. ccx\n"
    "is the first one in PATH, and uses as many cores as OMP_NUM_THREADS says.\n\n"
    "Examples:\n"
    "  misalign stress search/patterns/table1.json --output stress\n"
    "  misalign stress results/miura-6x6-1a2b3c4d.db 1234 --from 90 --mesh 4 --output stress\n"
    "  misalign stress search/patterns/table1.json --material steel.json --thickness 0.5 \\\n"
    "    --output stress";

}  // namespace

Action stress_verb(CLI::App& verb) {
  verb.description("elastic panels, let go: do they deploy, and what do they suffer (CalculiX)");
  verb.footer(kStressFooter);
  auto call = std::make_shared<StressCall>();
  add_catalogue_or_pattern(verb, call->path);
  add_draw_of_catalogue(verb, call->draw);
  add_stiffness(verb, call->actuators.stiffness_n_per_mm);
  add_release(verb, call->release);
  add_deck(verb, call->deck);
  StressStudyOptions& options = call->options;
  verb.add_option("--time-limit", options.deck.end_s,
                  fmt::format("end of the motion at the latest, s [{:g}]", options.deck.end_s))
      ->check(within(1e-6, 1e6))
      ->type_name("S");
  verb.add_option("--time-step", options.deck.time_step_s,
                  fmt::format("longest increment, s [{:g}]", options.deck.time_step_s))
      ->check(within(1e-9, 1))
      ->type_name("S");
  verb.add_option(
          "--damping", options.deck.damping_per_s,
          fmt::format("force against the velocity of all mass, per unit of both, 1/s [{:g}]",
                      options.deck.damping_per_s))
      ->check(within(0, 1e6))
      ->type_name("PER_S");
  verb.add_option("--disc", options.stress.disc_mm,
                  fmt::format("radius of the discs, mm [{:g}]", options.stress.disc_mm))
      ->check(within(0, 1e6))
      ->type_name("MM");
  verb.add_option("--output", call->directory, "directory, made if it is not there")
      ->required()
      ->type_name("DIR");
  verb.add_flag("--json", call->json, "as JSON, with all histories");
  return [call] {
    show_stress(*call);
    return 0;
  };
}

}  // namespace misalign::search
