#include "search/sheets/chosen_sheet.hpp"

#include <spdlog/spdlog.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/files/hash.hpp"
#include "schema/pattern/fill_words.hpp"
#include "schema/pattern/judging_fill.hpp"
#include "schema/pattern/obj_format.hpp"
#include "schema/pattern/pattern_document.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "solver/continuation/path.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {
namespace {

void judge(ChosenSheet& chosen, const schema::Design& options,
           std::optional<solver::CertifiedBy> criterion) {
  if (!criterion) return;
  if (*criterion == solver::CertifiedBy::diagonals) return chosen.judge_by({});
  if (chosen.sampling.energy_of) return;
  const solver::Fill fill = options.merged_over(chosen.design).fill(chosen.base.base);
  if (!schema::can_judge(fill)) {
    throw schema::UserError(solver::OptionFault{
        "criterion", "energy",
        "needs a filling that is relaxed flat and equal in all holes, and this is " +
            schema::filling_words(fill, 2 * static_cast<int>(chosen.base.base.holes.size()),
                                  schema::kDegreeWord),
        "change the design's filling, or take it out"});
  }
  chosen.judge_by(fill);
}

}  // namespace

StationOptions station_of_use(const schema::Design& design, const schema::Sampling& sampling) {
  if (!design.from_deg) return {};
  const double away_deg = std::remainder(*design.from_deg, sampling.sample_deg);
  if (std::abs(away_deg) <= solver::kSameAngle_deg) return {};
  return {0, {*design.from_deg}};
}

std::string SheetKey::name() const { return draw ? "draw " + std::to_string(*draw) : pattern; }

schema::Json SheetKey::json() const {
  if (draw) return {{"draw", *draw}};
  return {{"pattern", pattern}};
}

schema::Json ChosenSheet::whose() const {
  schema::Json json = key().json();
  if (drawn) {
    json["campaign"] = schema::identity(drawn->campaign);
  } else {
    json["sheet"] = schema::hex(schema::hash_of(schema::pattern_json(base, shifts_mm).dump()));
  }
  return json;
}

void ChosenSheet::judge_by(const std::optional<solver::Fill>& fill) {
  sampling.energy_of = fill;
  if (!drawn) return;
  drawn->campaign.energy.reset();
  if (fill) drawn->campaign.energy = schema::EnergyAcceptance{*fill};
}

schema::Campaign ChosenSheet::as_campaign() const {
  schema::Campaign campaign;
  campaign.pattern = base;
  campaign.sample_deg = campaign.threshold_deg = sampling.sample_deg;
  campaign.end_deg = sampling.end_deg;
  campaign.between_samples = sampling.between_samples;
  if (sampling.energy_of) campaign.energy = schema::EnergyAcceptance{*sampling.energy_of};
  if (target) campaign.target = std::make_shared<const schema::Target>(*target);
  return campaign;
}

bool is_pattern_file(const std::string& path) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  // A pipe can be read once only, and is no catalogue.
  if (kind != std::filesystem::file_type::regular) {
    return kind == std::filesystem::file_type::fifo ||
           kind == std::filesystem::file_type::character;
  }
  std::ifstream file(path, std::ios::binary);
  std::string start(std::size_t{1} << 16, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (start.starts_with("\xEF\xBB\xBF")) start.erase(0, 3);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  return first != std::string::npos &&
         (start[first] == '{' || start[first] == '[' || schema::is_obj(start));
}

void say_reading(const std::string& source, const schema::Pattern& pattern) {
  for (const std::string& sentence : pattern.reading) spdlog::info("{}: {}", source, sentence);
}

ChosenSheet sheet_of_pattern_file(const std::string& path, schema::Perforations perforations) {
  const std::filesystem::path file(path);
  return sheet_of_pattern_document(schema::read_pattern_document(path), path, file.parent_path(),
                                   schema::printable(schema::utf8(file.stem().string())),
                                   perforations);
}

ChosenSheet sheet_of_pattern_document(const schema::Json& document, const std::string& source,
                                      const std::filesystem::path& directory,
                                      const std::string& name, schema::Perforations perforations) {
  schema::PatternFile read =
      schema::read_sampled_pattern(document, source, directory, perforations);
  read.sampling.end_deg = std::min(read.sampling.end_deg, read.pattern.base.folding.end_deg());
  const Eigen::Matrix2Xd shifts_mm = read.pattern.shifts_mm;
  return {std::move(read.pattern),  read.sampling,         read.design, shifts_mm, {}, name,
          std::move(read.exported), std::move(read.target)};
}

ChosenSheet sheet_of_made_pattern(const schema::Json& document, const std::string& name) {
  return sheet_of_pattern_document(document, name, {}, name, schema::Perforations::of_one_path);
}

ChosenSheet sheet_of_draw(schema::Campaign campaign, std::uint64_t draw,
                          Eigen::Matrix2Xd shifts_mm) {
  auto target = campaign.target ? std::optional(*campaign.target) : std::nullopt;
  return {campaign.pattern,
          campaign.sampling(),
          campaign.design,
          std::move(shifts_mm),
          ChosenSheet::Drawn{std::move(campaign), draw},
          "",
          {},
          std::move(target)};
}

Subject::Subject(ChosenSheet what, const schema::Design& options)
    : chosen(std::move(what)),
      model(chosen.base, chosen.sampling, options.merged_over(chosen.design),
            station_of_use(options.merged_over(chosen.design), chosen.sampling)),
      sheet(model.sheet(chosen.shifts_mm, schema::printable(chosen.name()))) {}

Subject choose_sheet(const std::string& path, std::optional<std::uint64_t> draw,
                     const schema::Design& options, std::optional<solver::CertifiedBy> criterion) {
  if (is_pattern_file(path)) {
    if (draw) throw only_of_a_catalogue(path, "the draw " + std::to_string(*draw));
    ChosenSheet chosen = sheet_of_pattern_file(path);
    say_reading(path, chosen.base);
    judge(chosen, options, criterion);
    return {std::move(chosen), options};
  }
  const auto database = schema::open_for_reading(path);
  if (!draw) {
    throw schema::UserError(schema::Cause::bad_request,
                            path +
                                ": no DRAW is given (a catalogue holds many); name one, such as a "
                                "candidate that `misalign query` shows");
  }
  schema::Campaign campaign = schema::read_campaign_of(*database, path);
  Eigen::Matrix2Xd shifts_mm = shifts_of_number(*database, campaign, *draw);
  ChosenSheet chosen = sheet_of_draw(std::move(campaign), *draw, std::move(shifts_mm));
  judge(chosen, options, criterion);
  return {std::move(chosen), options};
}

void warn_beyond_d(const solver::Sheet& sheet, std::optional<double> from_deg) {
  const double d_deg = sheet.deploys_from_deg();
  if (!from_deg || d_deg <= 0 || !solver::beyond_d(sheet, *from_deg)) return;
  spdlog::warn(
      "released at {:.10g} deg, beyond D = {:.10g} deg of {}: not all diagonals are monotone there",
      *from_deg, d_deg, schema::printable(sheet.name()));
}

schema::UserError only_of_a_catalogue(const std::string& path, const std::string& what) {
  return schema::UserError(
      schema::Cause::bad_request,
      path + ": is a pattern, which is one sheet (" + what +
          " can only be chosen from a catalogue); take that out, or name a catalogue");
}

}  // namespace misalign::search
