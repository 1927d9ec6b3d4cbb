// Certificates of a campaign's first candidates against what close steps and the cubics between
// them say: a certificate ends at D, or where the first diagonal turns back.
//   certificates SHEETS CAMPAIGN...
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"
#include "search/terminal/stopwatch.hpp"
#include "solver/certificate/certifier.hpp"
#include "solver/verdict/history.hpp"

namespace misalign {
namespace {

constexpr double kSame_deg = 0.01;

struct Sums {
  int sheets = 0, to_d = 0, at_reversal = 0, unexplained = 0;
  std::size_t most_bytes = 0, bytes = 0;
  std::map<std::string, int> ends;
  std::vector<double> seconds, pieces;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

class Study {
 public:
  explicit Study(const schema::Campaign& campaign)
      : campaign_(campaign), model_(search::model_of(campaign)), certifier_(model_) {}

  void look(std::uint64_t draw, double deploys_from_deg) {
    const solver::FlatVertices vertices_mm =
        campaign_.pattern.base.sheet.vertices_mm + search::shifts_of_draw(campaign_, draw);
    const search::Stopwatch watch;
    const solver::Certificate certificate = certifier_.certify(vertices_mm, deploys_from_deg);
    sums_.seconds.push_back(watch.seconds());
    sums_.pieces.push_back(static_cast<double>(certificate.pieces.size()));
    const std::size_t bytes = encode(model_.mechanism(), certificate).size();
    sums_.bytes += bytes;
    sums_.most_bytes = std::max(sums_.most_bytes, bytes);
    ++sums_.sheets;
    ++sums_.ends[solver::name_of(certificate.end)];
    if (certificate.end == solver::CertificateEnd::to_the_end) {
      ++sums_.to_d;
      return;
    }
    const solver::FoldingHistory history = solver::record_history(model_, vertices_mm);
    const bool same = history.between.back_where >= 0 &&
                      std::abs(history.between.back_deg - certificate.certified_deg()) <= kSame_deg;
    sums_.at_reversal += same;
    sums_.unexplained += !same;
    if (!same) {
      fmt::print(
          "  draw {}: certified to {:.6f} of {} deg, {} {}; close steps: back at {:.6f} ({})\n",
          draw, certificate.certified_deg(), deploys_from_deg, solver::name_of(certificate.end),
          certificate.where, history.between.back_deg, history.between.back_where);
    }
  }

  bool print() const {
    if (sums_.sheets == 0) return true;
    std::string ends;
    for (const auto& [end, count] : sums_.ends) ends += fmt::format(" {} {}", end, count);
    fmt::print(
        "{}: {} sheets: {} to D, {} to the first reversal of the cubics, {} otherwise;{}; {:.1f} "
        "ms "
        "and {} pieces in the median, {:.1f} ms at most; {:.1f} kB in the mean, {:.1f} at most\n",
        campaign_.name, sums_.sheets, sums_.to_d, sums_.at_reversal, sums_.unexplained, ends,
        1e3 * median(sums_.seconds), median(sums_.pieces),
        1e3 * *std::max_element(sums_.seconds.begin(), sums_.seconds.end()),
        1e-3 * static_cast<double>(sums_.bytes) / sums_.sheets,
        1e-3 * static_cast<double>(sums_.most_bytes));
    std::fflush(stdout);
    return sums_.unexplained * 1000 <= sums_.sheets;
  }

 private:
  const schema::Campaign& campaign_;
  const solver::Model model_;
  solver::Certifier certifier_;
  Sums sums_;
};

bool look_at(schema::Campaign campaign, int sheets) {
  search::DrawEvaluator evaluator(campaign);
  Study study(campaign);
  int found = 0;
  for (std::uint64_t lo = 0; found < sheets; lo += evaluator.largest_block()) {
    std::uint64_t draw = lo;
    for (const solver::Verdict& verdict : evaluator.judge({lo, lo + evaluator.largest_block()})) {
      const double deploys_from_deg = verdict.deploys_from_sample * campaign.sample_deg;
      if (found < sheets && verdict.deploys_from_sample >= campaign.threshold_sample()) {
        study.look(draw, deploys_from_deg);
        ++found;
      }
      ++draw;
    }
  }
  return study.print();
}

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "certificates SHEETS CAMPAIGN...\n");
    return 2;
  }
  bool good = true;
  for (int k = 2; k < argc; ++k) {
    good = misalign::look_at(misalign::schema::read_campaign_file(argv[k]), std::stoi(argv[1])) &&
           good;
  }
  return good ? 0 : 1;
}
