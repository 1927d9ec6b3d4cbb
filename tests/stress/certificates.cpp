// Certificates of candidates beside what fine steps say of the same sheets: a certificate ends at
// D, or within a fine step of the first sample that shows a reversal: of a diagonal or, of a
// campaign that accepts by energy, of the energy.
//   certificates [--contact] [--check] SHEETS FILE...
// A file is a catalogue, whose first candidates are looked at, or a campaign, whose first draws
// are. --contact: proofs that no panels meet as well, beside where the folding way says that they
// first do. --check: the second opinion on every certificate.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/database.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/terminal/stopwatch.hpp"
#include "solver/certificate/certificate_check.hpp"
#include "solver/certificate/certifier.hpp"
#include "solver/contact/contact_finder.hpp"
#include "solver/contact/panel_motion.hpp"

namespace misalign {
namespace {

constexpr double kFine_deg = 0.01;
/// A certificate's end lies on one side of its interval of 1e-4 degrees, and so does a fine step.
constexpr double kSame_deg = kFine_deg + 2e-4;
constexpr double kSameContact_deg = 1e-3;
constexpr int kSheetsAtOnce = 64;

struct Sheet {
  std::uint64_t draw;
  Eigen::Matrix2Xd shifts_mm;
  double deploys_from_deg;
};

struct Options {
  bool contact = false, check = false;
  std::size_t sheets = 0;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

std::vector<Sheet> sheets_of_catalogue(SQLite::Database& database, const schema::Campaign& campaign,
                                       std::size_t most) {
  std::vector<Sheet> sheets;
  SQLite::Statement row(database, "SELECT draw, deploys_from_deg FROM candidates LIMIT ?");
  row.bind(1, static_cast<std::int64_t>(most));
  while (row.executeStep()) {
    const auto draw = static_cast<std::uint64_t>(row.getColumn(0).getInt64());
    sheets.push_back(
        {draw, search::shifts_of_number(database, campaign, draw), row.getColumn(1).getDouble()});
  }
  return sheets;
}

std::vector<Sheet> sheets_of_draws(const schema::Campaign& campaign, std::size_t most) {
  search::DrawEvaluator evaluator(campaign);
  std::vector<Sheet> sheets;
  for (std::uint64_t lo = 0; sheets.size() < most; lo += evaluator.largest_block()) {
    std::uint64_t draw = lo;
    for (const solver::Verdict& verdict : evaluator.judge({lo, lo + evaluator.largest_block()})) {
      if (sheets.size() < most && verdict.deploys_from_sample >= campaign.threshold_sample()) {
        sheets.push_back({draw, search::shifts_of_draw(campaign, draw),
                          verdict.deploys_from_sample * campaign.sample_deg});
      }
      ++draw;
    }
  }
  return sheets;
}

std::optional<solver::Fill> fill_of(const schema::Campaign& campaign) {
  return campaign.sampling().energy_of;
}

// The campaign's, without margins and other samples.
solver::Criterion fine_criterion(const schema::Campaign& campaign) {
  solver::Criterion criterion;
  if (const auto fill = fill_of(campaign)) criterion.energy = solver::EnergyCriterion{*fill};
  return criterion;
}

class Study {
 public:
  Study(const schema::Campaign& campaign, const Options& options)
      : campaign_(campaign),
        options_(options),
        model_(search::model_of(campaign)),
        fine_model_(campaign.pattern.base, solver::all_vertices(campaign.pattern.base.sheet),
                    {kFine_deg, campaign.end_deg, 0, 1}, 0, fine_criterion(campaign)),
        fine_(solver::make_batch(solver::available_instruction_sets().back(), fine_model_)),
        certifier_(model_, options.contact, fill_of(campaign)),
        solver_(model_) {}

  void look(const std::vector<Sheet>& sheets) {
    for (std::size_t first = 0; first < sheets.size(); first += kSheetsAtOnce) {
      const std::size_t last = std::min(first + kSheetsAtOnce, sheets.size());
      solver::ShiftBlock block;
      block.sheets = static_cast<int>(last - first);
      for (std::size_t k = first; k < last; ++k) {
        const Eigen::Matrix2Xd& shifts_mm = sheets[k].shifts_mm;
        block.shifts_mm.insert(block.shifts_mm.end(), shifts_mm.data(),
                               shifts_mm.data() + shifts_mm.size());
      }
      const auto& verdicts = fine_->judge(block);
      for (std::size_t k = first; k < last; ++k) look(sheets[k], verdicts[k - first]);
    }
  }

  void print() const {
    if (sheets_ == 0) return;
    std::string ends;
    for (const auto& [end, count] : ends_) ends += fmt::format(", {} {}", end, count);
    fmt::print(
        "{}: {} sheets{}; {} to D, {} to the first reversal of fine steps, {} otherwise; {:.1f} ms "
        "in the median, {:.1f} ms at most; {} intervals in the median; {:.1f} kB in the mean, "
        "{:.1f} at most",
        campaign_.name, sheets_, ends, to_d_, at_reversal_, unexplained_, 1e3 * median(seconds_),
        1e3 * *std::max_element(seconds_.begin(), seconds_.end()), median(intervals_),
        1e-3 * static_cast<double>(bytes_) / sheets_, 1e-3 * static_cast<double>(most_bytes_));
    fmt::print("; ends {:.4f} deg from fine steps' in the median", median(gaps_deg_));
    if (options_.contact) fmt::print("; {} at the first contact", at_contact_);
    if (options_.check) {
      fmt::print("; checked again {}, of these refused {}, {:.0f} ms in the median",
                 check_seconds_.size(), refused_, 1e3 * median(check_seconds_));
    }
    fmt::print("\n");
    std::fflush(stdout);
  }

  bool is_good() const { return unexplained_ * 1000 <= sheets_ && refused_ == 0; }

 private:
  void look(const Sheet& sheet, const solver::Verdict& fine) {
    const solver::FlatVertices vertices_mm =
        campaign_.pattern.base.sheet.vertices_mm + sheet.shifts_mm;
    const search::Stopwatch watch;
    const solver::Certificate certificate = certifier_.certify(vertices_mm, sheet.deploys_from_deg);
    seconds_.push_back(watch.seconds());
    intervals_.push_back(static_cast<double>(certificate.intervals.size()));
    const std::string bytes = encode(model_.mechanism(), certificate);
    bytes_ += bytes.size();
    most_bytes_ = std::max(most_bytes_, bytes.size());
    ++sheets_;
    ++ends_[solver::name_of(certificate.end)];
    if (!is_explained(certificate, fine.deploys_from_sample * kFine_deg, vertices_mm)) {
      ++unexplained_;
      fmt::print(
          "  draw {}: certified to {:.6f} of {} deg, {} {}; fine steps: in order to {:.2f}\n",
          sheet.draw, certificate.certified_deg(), sheet.deploys_from_deg,
          solver::name_of(certificate.end), certificate.where,
          fine.deploys_from_sample * kFine_deg);
    }
    if (options_.check) check(sheet.draw, vertices_mm, bytes);
  }

  // Counts it as what it is.
  bool is_explained(const solver::Certificate& certificate, double fine_deg,
                    const solver::FlatVertices& vertices_mm) {
    const double certified_deg = certificate.certified_deg();
    if (certificate.end == solver::CertificateEnd::to_the_end) {
      ++to_d_;
      return fine_deg >= certified_deg - 1e-9;
    }
    if (certificate.end == solver::CertificateEnd::contact) {
      const solver::Sheet sheet(solver_, vertices_mm - model_.base().sheet.vertices_mm);
      const auto motion = solver::resolved_motion(sheet);
      if (!motion) return false;
      const auto contact =
          solver::ContactFinder(sheet.panels(), *motion).first(motion->resolved_until());
      const bool same = contact && std::abs(contact->pilot_deg - certified_deg) <= kSameContact_deg;
      at_contact_ += same;
      return same;
    }
    const bool same = std::abs(fine_deg - certified_deg) <= kSame_deg;
    at_reversal_ += same;
    gaps_deg_.push_back(std::abs(fine_deg - certified_deg));
    return same;
  }

  void check(std::uint64_t draw, const solver::FlatVertices& vertices_mm,
             const std::string& bytes) {
    const search::Stopwatch watch;
    const auto kept = solver::decode(model_.mechanism(), bytes);
    const auto fault =
        kept ? solver::check_certificate(model_, vertices_mm, *kept, fill_of(campaign_))
             : solver::CertificateFault{0, 180, "these are the bytes of no certificate"};
    check_seconds_.push_back(watch.seconds());
    if (!fault) return;
    ++refused_;
    fmt::print("  draw {}: refused from {:.4f} to {:.4f} deg: {}\n", draw, fault->from_deg,
               fault->to_deg, fault->what);
  }

  const schema::Campaign& campaign_;
  const Options options_;
  const solver::Model model_, fine_model_;
  const std::unique_ptr<solver::Batch> fine_;
  solver::Certifier certifier_;
  solver::SheetSolver solver_;
  int sheets_ = 0, to_d_ = 0, at_reversal_ = 0, at_contact_ = 0, unexplained_ = 0, refused_ = 0;
  std::size_t bytes_ = 0, most_bytes_ = 0;
  std::map<std::string, int> ends_;
  std::vector<double> seconds_, intervals_, check_seconds_, gaps_deg_;
};

bool look_at(const std::string& path, const Options& options) {
  const auto study = [&](const schema::Campaign& campaign, const std::vector<Sheet>& sheets) {
    Study all(campaign, options);
    all.look(sheets);
    all.print();
    return all.is_good();
  };
  if (search::is_pattern_file(path)) {
    const schema::Campaign campaign = schema::read_campaign_file(path);
    return study(campaign, sheets_of_draws(campaign, options.sheets));
  }
  const auto database = schema::open_for_reading(path);
  const schema::Campaign campaign = schema::read_campaign_of(*database, path);
  return study(campaign, sheets_of_catalogue(*database, campaign, options.sheets));
}

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  misalign::Options options;
  int next = 1;
  for (; next < argc && argv[next][0] == '-'; ++next) {
    options.contact = options.contact || std::string(argv[next]) == "--contact";
    options.check = options.check || std::string(argv[next]) == "--check";
  }
  if (argc - next < 2) {
    fmt::print(stderr, "certificates [--contact] [--check] SHEETS FILE...\n");
    return 2;
  }
  options.sheets = std::stoul(argv[next++]);
  bool good = true;
  for (; next < argc; ++next) good = misalign::look_at(argv[next], options) && good;
  return good ? 0 : 1;
}
