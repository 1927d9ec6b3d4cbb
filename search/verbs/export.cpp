// `misalign export`: chosen candidates, or a pattern, as files.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/certificate_row.hpp"
#include "schema/catalogue/yield.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/export_files.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/choice_options.hpp"
#include "search/verbs/kit_options.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ExportCall {
  ExportOptions files;
  Choice choice;
  ReleaseCall release;
  DeckCall deck;
  KitCall kit;
  std::string hinge;  // a name of the hinge table

  // Takes over the sheets' design, into which typed options are merged already.
  void take(const schema::Design& design) {
    files.release = release.of(design);
    files.deck = deck.of(design);
    files.kit = chosen_kit(kit, design);
    files.must_reach = release.design.from_deg.has_value();
  }
};

// Adds a station at the angle of use to files that need one.
StationOptions stations_of(const ExportOptions& files, const schema::Design& design,
                           const schema::Sampling& sampling) {
  if (!files.knows_angle_of_use()) return {files.look_deg()};
  StationOptions stations = station_of_use(design, sampling);
  stations.step_deg = files.look_deg();
  return stations;
}

// Adds a candidate's certificate, if it has one, to `origin`.
void add_certificate(SQLite::Database& database, const schema::Pattern& base,
                     const solver::Sheet& sheet, std::uint64_t draw, schema::Json& origin) {
  const auto row = schema::read_certificate(database, draw);
  if (!row) return;
  const auto fault = schema::certificate_fault(base, sheet.mechanism(), sheet.shifts_mm(), *row);
  if (fault) {
    throw schema::UserError(schema::Cause::bad_input,
                            fmt::format("{}: the certificate of draw {} is not as it was made "
                                        "({}); `misalign certify` makes it anew",
                                        database.getFilename(), draw, *fault));
  }
  origin["certificate"] = schema::certificate_json(*row);
}

// Writes each candidate's files, or for csv one table of all of them, whole or not at all: named
// after the campaign and the draw, or a table of several after the campaign.
void export_candidates(ExportCall& call) {
  const auto database = schema::open_for_reading(call.files.read_from);
  add_study_functions(*database, call.files.read_from);
  const std::vector<std::uint64_t> draws = chosen_draws(*database, call.choice);
  schema::Campaign campaign = schema::read_campaign_of(*database, call.files.read_from);
  campaign.design = call.release.design.merged_over(campaign.design);
  call.take(campaign.design);
  FoldingModel model(campaign, stations_of(call.files, campaign.design, campaign.sampling()));
  const auto stem_of = [&](std::uint64_t draw) {
    return campaign.name + "-" + std::to_string(draw);
  };
  ExportFiles files(model, call.files);
  make_directory(call.files.directory);
  std::optional<ExportTables> tables;
  if (call.files.format == ExportFormat::csv) {
    const std::vector<std::uint64_t>& named = call.choice.draws;
    tables.emplace(model, call.files, named.size() == 1 ? stem_of(named[0]) : campaign.name,
                   "draw");
  }
  std::uint64_t written = 0;
  for (const std::uint64_t draw : draws) {
    show_work("sheets written", written++, draws.size());
    const std::string number = std::to_string(draw);
    const solver::Sheet sheet =
        model.sheet(shifts_of_number(*database, campaign, draw), "draw " + number);
    if (!campaign.accepts(sheet.verdict())) {
      throw schema::damaged(*database, "draw " + number + " is among the candidates, but is none");
    }
    if (tables) {
      tables->add(sheet, number);
      continue;
    }
    schema::Json origin = schema::origin_json(
        campaign, draw, schema::yields_json(schema::read_yields(*database, draw)));
    if (call.files.format == ExportFormat::json) {
      add_certificate(*database, campaign.pattern, sheet, draw, origin);
    }
    files.write(sheet, {stem_of(draw), "misalign: " + campaign.name + ", draw " + number}, origin);
  }
  if (tables) tables->publish();
}

// Exports the sheet of a pattern file.
void export_pattern(ExportCall& call) {
  const ChosenSheet chosen = sheet_of_pattern_file(call.files.read_from);
  const schema::Design design = call.release.design.merged_over(chosen.design);
  call.take(design);
  FoldingModel model(chosen.base, chosen.sampling, design,
                     stations_of(call.files, design, chosen.sampling));
  ExportFiles files(model, call.files);
  make_directory(call.files.directory);
  const solver::Sheet sheet = model.sheet(chosen.shifts_mm, chosen.pattern);
  const std::string stem = std::filesystem::path(call.files.read_from).stem().string();
  if (call.files.format == ExportFormat::csv) {
    ExportTables tables(model, call.files, stem, "pattern");
    tables.add(sheet, chosen.pattern);
    tables.publish();
    return;
  }
  files.write(sheet, {stem, "misalign: " + chosen.pattern}, schema::Json::object());
}

// Refuses options that the requested format does not use.
void refuse_idle_options(const ExportOptions& files, const KitCall& kit, const CLI::App& verb) {
  const auto only_with = [&](const char* option, bool has_sense, const char* with) {
    refuse_idle(verb.count(option) > 0, option, has_sense, with);
  };
  only_with("--step", files.in_states() && !(kit.wanted && files.is_printed()),
            "--format fold, obj or stl (without --kit)");
  only_with("--joined", files.format == ExportFormat::fold, "--format fold");
  for (const char* option : {"--creases", "--every"}) {
    only_with(option, files.format == ExportFormat::csv, "--format csv");
  }
  only_with("--rest-deg", files.is_simulated() || kit.wanted, "--format mjcf or inp, or --kit");
  only_with("--density", files.is_simulated(), "--format mjcf or inp");
  only_with("--from", files.knows_angle_of_use() || kit.wanted,
            "--format json, fold, stl, mjcf or inp, or --kit");
  only_with("--thickness", files.is_simulated() || files.format == ExportFormat::stl || kit.wanted,
            "--format stl, mjcf or inp, or --kit");
  only_with("--trim", files.format == ExportFormat::stl || kit.wanted, "--format stl, or --kit");
  only_with("--hinge", kit.wanted || files.format == ExportFormat::mjcf, "--kit, or --format mjcf");
  for (const char* option : {"--hold-flat", "--joint", "--wire"}) {
    only_with(option, kit.wanted, "--kit");
  }
  only_with("--kit", files.is_drawn() || files.is_printed(), "--format svg, dxf, stl or 3mf");
  only_with("--only-cut", files.is_drawn(), "--format svg or dxf");
  for (const char* option : {"--guide", "--test-piece", "--bed", "--kerf", "--grain", "--units",
                             "--gap", "--margin", "--bond"}) {
    only_with(option, files.is_drawn(), "--format svg or dxf");
  }
  for (const char* option : {"--pin", "--slot", "--ball"}) {
    only_with(option, files.is_printed(), "--format stl or 3mf");
  }
  for (const char* option : kKitOptions) only_with(option, verb.count("--kit") > 0, "--kit");
  const auto only_of = [&](const char* option, schema::CreaseCut crease, const char* with) {
    only_with(option, !kit.crease || kit.crease == crease, with);
  };
  only_of("--pin", schema::CreaseCut::pin, "--crease pin");
  only_of("--slot", schema::CreaseCut::film, "--crease film");
  only_with("--spring-at", kit.options.spring_bore_mm.has_value(), "--spring-bore");
  only_with("--dash-mm", kit.crease == schema::CreaseCut::dash, "--crease dash");
  only_with("--friction", files.format == ExportFormat::mjcf, "--format mjcf");
  only_with("--mesh", files.format == ExportFormat::inp, "--format inp");
  only_with("--material", files.format == ExportFormat::inp || kit.wanted,
            "--format inp, or --kit");
}

void run_export(ExportCall& call, const CLI::App& verb, const CLI::App& choice) {
  const std::string& path = call.files.read_from;
  if (call.files.format == ExportFormat::three_mf && !call.kit.wanted) {
    throw schema::UserError(schema::Cause::bad_request,
                            "--format 3mf is of plates to print; add --kit");
  }
  refuse_idle_options(call.files, call.kit, verb);
  read_material(call.deck.material, call.release.design);
  read_hinge(call.hinge, call.release.design);
  call.files.warn = [](const std::string& words) { spdlog::warn("{}", words); };
  const std::string chosen_by = first_given(choice);
  if (is_pattern_file(path)) {
    if (!chosen_by.empty()) throw only_of_a_catalogue(path, chosen_by);
    export_pattern(call);
  } else if (chosen_by.empty()) {
    throw schema::UserError(schema::Cause::bad_request,
                            path +
                                ": no candidates are chosen (a catalogue holds many); add --best, "
                                "--draw, --where or --diverse");
  } else {
    check_by(call.choice);
    export_candidates(call);
  }
}

constexpr const char* kExportFooter =
    "Formats:\n"
    "  json  pattern, verdict, metrics, springs, the certificate if there is one\n"
    "  csv   one table of all draws, a row for each draw, degree and diagonal: length,\n"
    "        elongation (a share: 0.02 = 2 %), the spring's force, energy and moment (over\n"
    "        the diagonals they add up to the sheet's), the sheet's mechanical advantage;\n"
    "        diagonals are numbered from 0, as in the view diagonals. --every 10: only flat,\n"
    "        10, 20, 30 deg ... and D, a tenth of the size\n"
    "  mat   for MATLAB and Octave (MAT-file, level 5): coordinates, histories of diagonals,\n"
    "        creases and vertices, springs, metrics; its variable readme names axes and units\n"
    "  fold  crease pattern and folded states, for Origami Simulator and the like. Panels that\n"
    "        ball joints alone hold are placed by the states; with --joined also by creases: two\n"
    "        triangles in the corner of a hole make three hinges of a ball joint\n"
    "  svg   true scale: layers for a cutter, hidden ones for springs and labels\n"
    "  dxf   the same for CAD (AutoCAD 2000, mm)\n"
    "  obj   one file for each folded state\n"
    "  stl   the same of plates with --thickness, tapered and trimmed as in `contact`: a\n"
    "        closed solid for each panel; with --kit the plates of a kit, flat, to print\n"
    "  3mf   with --kit: the same plates in one file\n"
    "  mjcf  the sheet folded to --from, ready for release, for MuJoCo: rigid panels, hinges,\n"
    "        ball joints, springs as tendons\n"
    "  inp   the same for CalculiX: elastic panels\n"
    "mat needs a program built with matio, dxf with dxflib (misalign --version).\n"
    "Where two holes meet, the panels between them touch in a point. The sheet needs a ball\n"
    "joint there, which is in the files of mjcf and inp alone. Files are named after the campaign "
    "and the draw, or after the\n"
    "pattern file.\n\n"
    "A kit to cut (svg and dxf, or to print: stl and 3mf, --kit; NAME-kit, with --bed NAME-kit-1, "
    "NAME-kit-2, ...):\n"
    "  Panels that creases join are one part; those that ball joints alone hold lie beside it.\n"
    "  Panel r1c2 is [1, 2] of pattern files and catalogues, A10 a vertex, s3 diagonal 3.\n"
    "  Layers in order: registration, engrave, score or dash (_mountain, _valley), bore, slit,\n"
    "  opening (inner contours), cut (outer ones), in colours of LightBurn's palette; not to\n"
    "  be cut: engrave (numbers, as lines). Three registration marks, bores of 3 mm, serve to\n"
    "  place a sheet again. Outlines lie close together, --gap apart, turned as fits (--grain: by\n"
    "  half turns alone).\n"
    "  Where two holes meet, the part's contours touch in the ball joint's point. With --kerf\n"
    "  they do not quite; slit cuts through there.\n"
    "  With --joint-bore each ball joint has a bore in both of its panels, on the bisector of the\n"
    "  corner, --bore-edge off the edges: for a loop of wire. --spring-bore: springs end on the\n"
    "  vertices of their diagonals, where the verdict holds. At a corner of one hole the panel\n"
    "  across has a tab, a disc with the bore in its middle, which its neighbours are cut clear\n"
    "  of; at a ball joint the spring hangs in the joint's wire. --spring-at panel: in bores\n"
    "  inside panels near the vertices, which turn with them. A kit whose springs contradict the\n"
    "  verdict says so first. NAME-kit.html is a guide to print: parts to buy, the sheets of\n"
    "  material, the assembly row by row with pictures, and tables of shifts, springs and hinges\n"
    "  up to --from. --thickness, --material, --hinge, --stiffness, --preload, --rest-deg, --fill\n"
    "  and --hold-flat override the design's.\n\n"
    "Examples:\n  misalign export results/miura-6x6-1a2b3c4d.db --best 3 --output out\n"
    "  misalign export results/miura-6x6-1a2b3c4d.db --draw 1234 --format svg --output out\n"
    "  misalign export results/miura-6x6-1a2b3c4d.db --diverse 5 \\\n"
    "    --where \"stroke_max < 0.08\" --format fold --step 5 --output out\n"
    "  misalign export results/miura-6x6-1a2b3c4d.db --best 1000 --format csv --every 5 --output "
    "out\n"
    "  misalign export search/patterns/table1.json --format svg --output out\n"
    "  misalign export search/patterns/table1.json --format dxf --kit --kerf 0.15 \\\n"
    "    --joint-bore 1.2 --spring-bore 1.5 --bed 600x400 --output out\n"
    "  misalign export search/patterns/table1.json --format mjcf --from 90 --output out";

}  // namespace

Action export_verb(CLI::App& verb) {
  verb.description("chosen candidates, or a pattern, as files");
  verb.footer(kExportFooter);
  auto call = std::make_shared<ExportCall>();
  Choice& choice = call->choice;
  ExportOptions& files = call->files;
  add_catalogue_or_pattern(verb, files.read_from);
  auto* group =
      verb.add_option_group("choice", "which candidates of a catalogue (at least one of these)");
  auto* draw = add_draws(*group, choice.draws, "this draw");
  const ChoiceOptions chosen = add_choice(verb, *group, choice);
  for (CLI::Option* other : {chosen.best, chosen.diverse, chosen.where}) draw->excludes(other);
  verb.add_option("--format", files.format, "format of the files, see above [json]")
      ->transform(one_of<ExportFormat>({{"json", ExportFormat::json},
                                        {"csv", ExportFormat::csv},
                                        {"mat", ExportFormat::mat},
                                        {"fold", ExportFormat::fold},
                                        {"svg", ExportFormat::svg},
                                        {"dxf", ExportFormat::dxf},
                                        {"obj", ExportFormat::obj},
                                        {"stl", ExportFormat::stl},
                                        {"3mf", ExportFormat::three_mf},
                                        {"mjcf", ExportFormat::mjcf},
                                        {"inp", ExportFormat::inp}}));
  add_value(verb, "--step", files.step_deg,
            "fold, obj and stl: step of the pilot angle between states, degrees [10]",
            within(0.01, 180), "DEG");
  verb.add_flag("--joined", files.joined,
                "fold: with triangles that stand for ball joints by hinges, see above");
  verb.add_flag("--creases", files.creases, "with csv: also NAME-creases.csv, of fold angles");
  add_value(verb, "--every", files.every_deg,
            "csv: only samples that are multiples of this, flat and D [every sample]",
            within(0.01, 180), "DEG");
  add_trim(verb, files.trim_mm);
  add_springs(verb, call->release.design);
  add_release(verb, call->release);
  add_fill(verb, call->release.design);
  add_value(verb, "--friction", call->release.design.friction_n_mm_per_mm,
            "mjcf: dry friction of the hinges in the tree, N mm/mm [the design's, or 0]",
            within("hinges.friction_n_mm_per_mm"), "N");
  add_hinge(verb, call->hinge);
  add_hold_flat(verb, call->release.design.hold_flat);
  add_deck(verb, call->deck);
  add_joint(verb, call->release.design);
  verb.add_flag("--only-cut", files.only_cut,
                "svg and dxf: without the layers that are not to be cut, for programs that follow "
                "hidden layers and marks, too");
  add_kit(verb, call->kit);
  verb.add_option("--output", files.directory, "directory, made if it is not there")
      ->required()
      ->type_name("PATH");
  add_jobs(verb);
  return [call, &verb, group] {
    run_export(*call, verb, *group);
    return 0;
  };
}

}  // namespace misalign::search
