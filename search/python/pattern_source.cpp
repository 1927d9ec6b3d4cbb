#include "search/python/pattern_source.hpp"

#include <fstream>

#include "schema/campaign/campaign_file.hpp"
#include "schema/files/output_file.hpp"
#include "schema/pattern/design_json.hpp"
#include "schema/pattern/judging_fill.hpp"
#include "schema/pattern/pattern_document.hpp"
#include "solver/play/tolerance.hpp"

namespace misalign::search::python {
namespace {

bool is_database(const std::string& path) {
  if (path.find('\0') != std::string::npos) return false;  // no possible file name
  std::ifstream file(path, std::ios::binary);
  std::string start(schema::kDatabaseHeader.size(), ' ');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == schema::kDatabaseHeader;
}

double safe_amplitude_mm(const schema::Pattern& pattern) {
  return solver::largest_miscut_mm(pattern.base.sheet,
                                   Eigen::Matrix2Xd::Zero(2, pattern.base.sheet.vertex_count()));
}

std::shared_ptr<PatternSource> source_of_pattern(ChosenSheet sheet) {
  PatternSource source{std::move(sheet), {}, {}, {}, "", 0};
  source.safe_mm = safe_amplitude_mm(source.sheet.base);
  const schema::Sampling& sampling = source.sheet.sampling;
  source.criterion = sampling.criterion();
  source.usual = solver::interior_vertices(source.pattern());
  const schema::Pattern& base = source.sheet.base;
  const Eigen::Matrix2Xd none_mm = Eigen::Matrix2Xd::Zero(2, source.vertices());
  source.key = schema::pattern_json(base, none_mm).dump() + schema::sampling_json(sampling).dump();
  return std::make_shared<PatternSource>(std::move(source));
}

}  // namespace

std::shared_ptr<PatternSource> source_of(schema::Campaign campaign) {
  ChosenSheet sheet{campaign.pattern,
                    campaign.sampling(),
                    campaign.design,
                    campaign.pattern.shifts_mm,
                    {},
                    campaign.name,
                    {}};
  const solver::Criterion criterion = campaign.criterion();
  std::vector<int> usual = campaign.misalignment.vertices;
  std::string key = schema::identity_json(campaign).dump();
  const double safe_mm = safe_amplitude_mm(campaign.pattern);
  return std::make_shared<PatternSource>(PatternSource{
      std::move(sheet), criterion, std::move(campaign), std::move(usual), std::move(key), safe_mm});
}

std::shared_ptr<PatternSource> read_source(const std::string& path) {
  if (is_database(path)) {
    throw schema::UserError(
        schema::Cause::bad_request,
        path + ": is a catalogue, which holds many sheets; open it with misalign.Catalogue");
  }
  if (schema::is_campaign(schema::read_pattern_document(path, schema::FileKind::regular))) {
    return source_of(schema::read_campaign_file(path));
  }
  return source_of_pattern(sheet_of_pattern_file(path, schema::Perforations::of_one_path));
}

std::shared_ptr<PatternSource> read_document(const std::string& text, const std::string& name) {
  const schema::Json document = schema::parse_json(text, name);
  if (schema::is_campaign(document)) {
    return source_of(schema::read_campaign(document, name, std::filesystem::current_path()));
  }
  return source_of_pattern(sheet_of_pattern_document(
      document, name, std::filesystem::current_path(), name, schema::Perforations::of_one_path));
}

std::shared_ptr<PatternSource> with_shifts(const PatternSource& source,
                                           const Eigen::Matrix2Xd& shifts_mm,
                                           const std::string& name) {
  ChosenSheet sheet = source.sheet;
  sheet.shifts_mm = sheet.base.shifts_mm = shifts_mm;
  sheet.drawn.reset();
  sheet.pattern = name;
  sheet.exported = nullptr;
  return source_of_pattern(std::move(sheet));
}

std::shared_ptr<PatternSource> judged_by(const PatternSource& source, const std::string& accept) {
  const schema::Json json = schema::parse_json(accept, "the criterion");
  schema::InputFaults faults;
  schema::ObjectReader reader(json, "", faults);
  const std::optional<solver::Fill> fill =
      schema::read_judging_fill(reader, source.sheet.base.base);
  reader.refuse_unknown_keys();
  faults.refuse("the criterion");
  PatternSource judged = source;
  judged.sheet.judge_by(fill);
  judged.criterion.energy = judged.sheet.sampling.criterion().energy;
  if (judged.campaign) {
    judged.campaign->energy.reset();
    if (fill) judged.campaign->energy = schema::EnergyAcceptance{*fill};
  }
  judged.key += schema::judging_fill_json(fill).dump();
  return std::make_shared<PatternSource>(std::move(judged));
}

void write_source(const PatternSource& source, const std::string& path) {
  const ChosenSheet& sheet = source.sheet;
  const schema::Json json =
      source.campaign
          ? schema::campaign_json(*source.campaign)
          : schema::pattern_file_json(sheet.base, sheet.shifts_mm, sheet.sampling, sheet.design);
  schema::write_text_file(path, json.dump(1) + "\n");
}

std::string text_of(const PatternSource& source) {
  if (source.campaign) return schema::Json{{"campaign", campaign_json(*source.campaign)}}.dump();
  const ChosenSheet& sheet = source.sheet;
  return schema::Json{{"name", sheet.pattern},
                      {"pattern", schema::pattern_json(sheet.base, sheet.shifts_mm)},
                      {"sampling", schema::sampling_json(sheet.sampling)},
                      {"design", schema::explicit_design_json(sheet.design)},
                      {"exported", sheet.exported}}
      .dump();
}

std::shared_ptr<PatternSource> source_of_text(const std::string& text) {
  const schema::Json json = schema::Json::parse(text);
  if (json.contains("campaign")) {
    return source_of(schema::read_campaign(json["campaign"], "a pickled campaign"));
  }
  schema::InputFaults faults;
  schema::Pattern pattern =
      schema::read_pattern(json.at("pattern"), "pattern", schema::Displacements::allowed, {},
                           faults, schema::Perforations::of_one_path);
  schema::ObjectReader reader(json.at("sampling"), "sampling", faults);
  schema::Sampling sampling;
  reader.number("sample_deg", sampling.sample_deg, 0, 180, "pickle it again");
  reader.number("end_deg", sampling.end_deg, 0, 180, "pickle it again");
  schema::read_between_samples(reader, pattern, sampling.between_samples);
  sampling.energy_of = schema::read_judging_fill(reader, pattern.base);
  const schema::Design design = schema::read_design(json.at("design"), "design", faults);
  faults.refuse("a pickled pattern");
  const Eigen::Matrix2Xd shifts_mm = pattern.shifts_mm;
  return source_of_pattern({std::move(pattern),
                            sampling,
                            design,
                            shifts_mm,
                            {},
                            json.at("name").get<std::string>(),
                            json.at("exported")});
}

}  // namespace misalign::search::python
