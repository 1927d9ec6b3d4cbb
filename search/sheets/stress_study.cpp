#include "search/sheets/stress_study.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "schema/files/text_file.hpp"

namespace misalign::search {
namespace {

using schema::ElasticRow;
using schema::Json;

// What has been added to a file since it was last looked at.
class GrowingFile {
 public:
  explicit GrowingFile(std::string path) : path_(std::move(path)) {}
  std::string news() {
    std::ifstream file(path_, std::ios::binary);
    file.seekg(seen_);
    std::ostringstream text;
    if (file) text << file.rdbuf();
    seen_ += static_cast<std::streamoff>(text.str().size());
    return text.str();
  }

 private:
  const std::string path_;
  std::streamoff seen_ = 0;
};

void cut_after_deployment(const StressStudyOptions& options, StressStudy& study) {
  const auto deployed =
      std::find_if(study.rows.begin(), study.rows.end(),
                   [&](const ElasticRow& row) { return row.widest_deg < options.flat_deg; });
  if (deployed == study.rows.end()) return;
  study.deployed_s = deployed->time_s;
  study.rows.erase(deployed + 1, study.rows.end());
}

// A start without an increment is no motion.
void check_begun(const StressStudy& study, const schema::MotionReader& motion,
                 const std::string& log) {
  if (study.rows.size() > 1) return;
  const std::string end = study.was_stopped ? "was stopped"
                          : motion.is_sound()
                              ? "ended with " + std::to_string(study.calculix.exit_code)
                              : "wrote what is no number, or none that can be,";
  throw schema::UserError(
      schema::kExitFailure,
      "ccx " + end + " before the end of its first increment; " + log + " is what it said");
}

Json at_json(const schema::SimulatedSheet& sheet, const std::optional<schema::StressAt>& at) {
  if (!at) return nullptr;
  return {{"stress_mpa", at->stress_mpa},
          {"time_s", at->time_s},
          {"panel", sheet.places[static_cast<std::size_t>(at->panel)]},
          {"x_mm", at->flat_mm.x()},
          {"y_mm", at->flat_mm.y()}};
}

Json rows_json(const std::vector<ElasticRow>& rows) {
  Json json;
  const auto add = [&](const char* key, double ElasticRow::*value) {
    json[key] = Json::array();
    for (const ElasticRow& row : rows) json[key].push_back(row.*value);
  };
  add("time_s", &ElasticRow::time_s);
  add("pilot_deg", &ElasticRow::pilot_deg);
  add("widest_deg", &ElasticRow::widest_deg);
  add("springs_n_mm", &ElasticRow::springs_n_mm);
  add("bending_n_mm", &ElasticRow::strain_n_mm);
  add("kinetic_n_mm", &ElasticRow::kinetic_n_mm);
  return json;
}

}  // namespace

std::optional<double> StressStudy::rigid_pilot_deg(double time_s) const {
  const auto after = std::find_if(rigid.begin(), rigid.end(),
                                  [&](const auto& row) { return row.time_s >= time_s; });
  if (after == rigid.end()) return {};
  if (after == rigid.begin()) return after->pilot_deg;
  // By the cubic through both rows with their rates.
  const auto& before = *(after - 1);
  const double h = after->time_s - before.time_s, s = (time_s - before.time_s) / h;
  return before.pilot_deg * (1 + 2 * s) * (1 - s) * (1 - s) +
         after->pilot_deg * s * s * (3 - 2 * s) +
         h * s * (1 - s) * (before.rate_deg_per_s * (1 - s) - after->rate_deg_per_s * s);
}

StressStudy study_stress(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                         const std::string& directory, const std::string& job,
                         const std::function<bool(const ElasticRow&)>& goes_on) {
  const std::string ccx = find_calculix();
  const RunDirectory run(directory, job);
  schema::write_text_file(job_file(run.path(), job, ".inp"),
                          schema::calculix_deck(sheet, options.deck));
  const schema::PanelMesh mesh(options.deck.elements);
  schema::MotionReader motion(sheet, mesh);
  GrowingFile dat(job_file(run.path(), job, ".dat"));
  std::size_t seen = 0;
  const auto is_flat = [&](const ElasticRow& row) { return row.widest_deg < options.flat_deg; };
  StressStudy study;
  study.calculix = run_calculix(ccx, run.path(), job, [&] {
    motion.feed(dat.news());
    const auto& rows = motion.rows();
    const bool deployed =
        std::any_of(rows.begin() + static_cast<std::ptrdiff_t>(seen), rows.end(), is_flat);
    seen = rows.size();
    return goes_on(rows.back()) && motion.is_sound() && !deployed;
  });
  motion.feed(dat.news());
  study.rows = motion.rows();
  std::ifstream frd(job_file(run.path(), job, ".frd"));
  run.publish();
  study.was_stopped = !goes_on(study.rows.back());
  check_begun(study, motion, job_file(directory, job, ".log"));
  cut_after_deployment(options, study);
  schema::StressOptions stress = options.stress;
  stress.until_s = study.rows.back().time_s;
  study.stress = schema::read_stresses(frd, job_file(directory, job, ".frd"), sheet, mesh, stress);
  const bool has_failed = !study.calculix.was_stopped && study.calculix.exit_code != 0;
  study.gave_up =
      !motion.is_sound() || !study.stress.is_sound || (has_failed && !study.was_stopped);
  return study;
}

Json stress_json(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                 const StressStudy& study) {
  Json panels = Json::array();
  for (std::size_t k = 0; k < sheet.places.size(); ++k) {
    panels.push_back(
        {{"panel", sheet.places[k]}, {"outside_discs_mpa", study.stress.panel_outside_mpa[k]}});
  }
  Json rigid = {{"time_s", Json::array()}, {"pilot_deg", Json::array()}};
  for (const solver::DeploymentRow& row : study.rigid) {
    rigid["time_s"].push_back(row.time_s);
    rigid["pilot_deg"].push_back(row.pilot_deg);
  }
  const Json history = {{"time_s", study.stress.time_s},
                        {"outside_discs_mpa", study.stress.outside_mpa},
                        {"anywhere_mpa", study.stress.anywhere_mpa}};
  return {{"from_deg", sheet.pilot_deg},
          {"rest_deg", sheet.rest_deg},
          {"stiffness_n_per_mm", sheet.stiffness_n_per_mm},
          {"thickness_mm", sheet.plates.thickness_mm},
          {"density_g_per_cm3", sheet.plates.density_g_per_cm3},
          {"material", schema::material_json(options.deck.material)},
          {"elements_a_side", options.deck.elements},
          {"time_step_s", options.deck.time_step_s},
          {"time_limit_s", options.deck.end_s},
          {"damping_per_s", options.deck.damping_per_s},
          {"disc_mm", options.stress.disc_mm},
          {"outcome", study.deployed_s    ? "deployed"
                      : study.was_stopped ? "stopped"
                      : study.gave_up     ? "failed"
                                          : "time_limit"},
          {"deployed_s", study.deployed_s ? Json(*study.deployed_s) : Json()},
          {"largest_outside_discs", at_json(sheet, study.stress.outside)},
          {"largest_anywhere_mesh_dependent", at_json(sheet, study.stress.anywhere)},
          {"panels", panels},
          {"motion", rows_json(study.rows)},
          {"rigid_motion", rigid},
          {"stress", history},
          {"cpu_s", study.calculix.cpu_s},
          {"memory_mb", study.calculix.memory_mb}};
}

}  // namespace misalign::search
