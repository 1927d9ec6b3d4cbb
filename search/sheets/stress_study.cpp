#include "search/sheets/stress_study.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "schema/exchange/calculix_motion.hpp"
#include "schema/files/output_file.hpp"
#include "search/sheets/calculix_run.hpp"

namespace misalign::search {
namespace {

using solver::StressStudy;

// Reads the end that was added to a file since the last look.
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

// A start without an increment is no motion.
void check_begun(const StressStudy& study, const CalculixEnd& end,
                 const schema::MotionReader& motion, const std::string& log) {
  if (study.rows.size() > 1) return;
  const std::string what = study.was_stopped   ? "was stopped"
                           : motion.is_sound() ? "ended with " + std::to_string(end.exit_code)
                                               : "wrote what is no number, or none that can be,";
  throw schema::UserError(
      schema::Cause::failure,
      "ccx " + what + " before the end of its first increment; " + log + " is what it said");
}

}  // namespace

StressStudy study_stress(const schema::SimulatedSheet& sheet, const StressStudyOptions& options,
                         const std::string& directory, const std::string& job,
                         const std::function<bool(const StressStudy::Row&)>& goes_on) {
  const std::string ccx = find_calculix();
  const RunDirectory run(directory, job);
  schema::write_text_file(job_file(run.path(), job, ".inp"),
                          schema::calculix_deck(sheet, options.deck));
  const schema::PanelMesh mesh(options.deck.elements);
  schema::MotionReader motion(sheet, mesh);
  GrowingFile dat(job_file(run.path(), job, ".dat"));
  std::size_t seen = 0;
  const auto is_flat = [&](const StressStudy::Row& row) {
    return row.widest_deg < options.flat_deg;
  };
  StressStudy study;
  const CalculixEnd end = run_calculix(ccx, run.path(), job, [&] {
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
  study.cpu_s = end.cpu_s;
  study.memory_mb = end.memory_mb;
  check_begun(study, end, motion, job_file(directory, job, ".log"));
  study.end_where_deployed(options.flat_deg);
  schema::StressOptions stress = options.stress;
  stress.until_s = study.rows.back().time_s;
  study.stress = schema::read_stresses(frd, job_file(directory, job, ".frd"), sheet, mesh, stress);
  const bool has_failed = !end.was_stopped && end.exit_code != 0;
  study.gave_up =
      !motion.is_sound() || !study.stress.is_sound || (has_failed && !study.was_stopped);
  return study;
}

}  // namespace misalign::search
