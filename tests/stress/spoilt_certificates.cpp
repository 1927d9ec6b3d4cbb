// Certificates of candidates, each spoilt in one way such that it claims what is not so: the check
// must refuse every one. They are read back from bytes, as with a hash that was mended.
//   spoilt_certificates TIMES SHEETS CAMPAIGN...    TIMES for each campaign, of its first SHEETS
//                                                   candidates in turn
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/models.hpp"
#include "solver/certificate/certificate_check.hpp"
#include "solver/certificate/certifier.hpp"
#include "solver/linear/newton.hpp"

namespace misalign {
namespace {

using solver::Certificate;
using solver::CertificateEnd;
using solver::FoldState;
using solver::PathInterval;

struct Certified {
  solver::FlatVertices vertices_mm;
  double deploys_from_deg;
  Certificate certificate;
  bool meets;  // whether panels do before it ends
};

class Spoiler {
 public:
  Spoiler(const schema::Campaign& campaign, const solver::Model& model, std::vector<Certified> all)
      : campaign_(campaign),
        model_(model),
        mechanism_(model.mechanism()),
        all_(std::move(all)),
        random_(1) {
    for (std::size_t k = 0; k < all_.size(); ++k) {
      sheets_[any].push_back(k);
      if (all_[k].certificate.end == CertificateEnd::reversal) sheets_[reversing].push_back(k);
      if (all_[k].meets) sheets_[meeting].push_back(k);
    }
  }

  /// One more, of the kind that is next. False if the check passes it.
  bool spoil_one() {
    const auto& [name, of, spoil] = kinds_[next_ % kinds_.size()];
    const std::size_t turn = next_++ / kinds_.size();
    if (sheets_[of].empty()) return true;
    Certified spoilt = all_[sheets_[of][turn % sheets_[of].size()]];
    (this->*spoil)(spoilt);
    const auto kept = solver::decode(mechanism_, solver::encode(mechanism_, spoilt.certificate));
    const auto fault = kept ? solver::check_certificate(model_, spoilt.vertices_mm, *kept)
                            : solver::CertificateFault{0, 180, "it is not read"};
    ++refusals_[name][fault ? fault->what : "PASSED"];
    return fault.has_value();
  }

  void print() const {
    for (const auto& [name, counts] : refusals_) {
      for (const auto& [what, count] : counts) fmt::print("| {} | {} | {} |\n", name, what, count);
    }
    std::fflush(stdout);
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Any size between, and either sign.
  double some(double least, double most) {
    const double size = std::exp(between(std::log(least), std::log(most)));
    return random_() % 2 == 0 ? size : -size;
  }
  std::size_t index(std::size_t count) { return random_() % count; }
  PathInterval& any_interval(Certificate& certificate) {
    return certificate.intervals[index(certificate.intervals.size())];
  }
  /// What an interval's unknowns of first order are measured by: near flat over the pilot's
  /// tangent.
  double scale_of(const PathInterval& interval) const {
    const auto& pilot = interval.middle.creases[static_cast<std::size_t>(mechanism_.pilot)];
    return interval.graded ? pilot.s / pilot.c : 1;
  }

  void spoil_crease(Certified& spoilt) {
    PathInterval& interval = any_interval(spoilt.certificate);
    auto& h = interval.middle.creases[index(interval.middle.creases.size())];
    const double turn = some(2 * solver::kMiddleBox, 0.1) * scale_of(interval);
    const double length = std::sqrt(1 + turn * turn);
    h = {(h.c - h.s * turn) / length, (h.s + h.c * turn) / length};
  }
  void spoil_ball(Certified& spoilt) {
    PathInterval& interval = any_interval(spoilt.certificate);
    auto& q = interval.middle.balls[index(interval.middle.balls.size())];
    const double turn = some(2 * solver::kMiddleBox, 0.1) * scale_of(interval);
    (random_() % 2 == 0 ? q.x : q.y) += turn;
    q = q.normalized();
  }
  void spoil_length(Certified& spoilt) {
    const std::vector<int>& inner = campaign_.misalignment.vertices;
    spoilt.vertices_mm(static_cast<int>(index(2)), inner[index(inner.size())]) += some(0.01, 0.4);
  }
  // The mirror image, which closes every loop as well.
  void take_mirror_image(Certified& spoilt) {
    PathInterval& interval = any_interval(spoilt.certificate);
    for (auto& h : interval.middle.creases) h.s = -h.s;
    for (auto& q : interval.middle.balls) q = {q.w, -q.x, -q.y, q.z};
  }
  void take_another_sheets(Certified& spoilt) {
    const std::size_t other = index(all_.size());
    const auto& theirs = all_[other].certificate;
    if ((theirs.intervals.front().middle.creases[0].s ==
         spoilt.certificate.intervals.front().middle.creases[0].s)) {
      return take_mirror_image(spoilt);
    }
    spoilt.certificate.intervals = theirs.intervals;
    spoilt.certificate.asked_deg = theirs.certified_deg();
    spoilt.certificate.end = CertificateEnd::to_the_end;
    spoilt.certificate.where = -1;
    spoilt.certificate.closing.reset();
  }
  void leave_a_gap(Certified& spoilt) {
    auto& intervals = spoilt.certificate.intervals;
    intervals.erase(intervals.begin() + static_cast<long>(index(intervals.size() - 1)));
  }
  void move_a_join(Certified& spoilt) {
    auto& intervals = spoilt.certificate.intervals;
    PathInterval& interval = intervals[index(intervals.size() - 1)];
    const double width_deg = interval.to_deg - interval.from_deg;
    interval.to_deg += some(0.001, 0.5) * std::min(1.0, width_deg);
  }
  void claim_no_contact(Certified& spoilt) { spoilt.certificate.contact = true; }

  /// As if nothing had happened, up to an angle.
  void go_on(Certified& spoilt, double to_deg) {
    Certificate& certificate = spoilt.certificate;
    FoldState<double> state = certificate.closing->middle;
    solver::SheetGeometry<double> geometry;
    solver::place(mechanism_, spoilt.vertices_mm, geometry);
    solver::Newton newton(mechanism_);
    constexpr double kWidth_deg = 0.1;
    certificate.closing.reset();
    certificate.where = -1;
    while (certificate.certified_deg() < to_deg) {
      PathInterval interval = certificate.intervals.back();
      interval.from_deg = interval.to_deg;
      interval.to_deg = std::min(to_deg, interval.from_deg + kWidth_deg);
      state.creases[static_cast<std::size_t>(mechanism_.pilot)] =
          solver::half_angle_of_deg(0.5 * (interval.from_deg + interval.to_deg));
      if (newton.correct(geometry, state).end != solver::Newton::StopReason::converged) break;
      interval.middle = state;
      interval.graded = false;
      interval.box = 1e-7;
      certificate.intervals.push_back(std::move(interval));
    }
    certificate.end = CertificateEnd::to_the_end;
    certificate.asked_deg = certificate.certified_deg();
  }
  void go_on_to_d(Certified& spoilt) { go_on(spoilt, spoilt.deploys_from_deg); }
  void go_on_a_little(Certified& spoilt) {
    go_on(spoilt, spoilt.certificate.closing->to_deg + between(0.001, 0.1));
  }
  void call_the_closing_interval_good(Certified& spoilt) {
    Certificate& certificate = spoilt.certificate;
    certificate.intervals.push_back(*certificate.closing);
    certificate.closing.reset();
    certificate.where = -1;
    certificate.end = CertificateEnd::to_the_end;
    certificate.asked_deg = certificate.certified_deg();
  }
  void name_another_diagonal(Certified& spoilt) {
    const int others = mechanism_.diagonal_count() - 1;
    spoilt.certificate.where =
        (spoilt.certificate.where + 1 + static_cast<int>(index(static_cast<std::size_t>(others)))) %
        (others + 1);
  }
  void name_a_crease(Certified& spoilt) {
    const auto creases = static_cast<int>(mechanism_.creases.size());
    spoilt.certificate.end =
        random_() % 2 == 0 ? CertificateEnd::over_folded : CertificateEnd::sign_changed;
    spoilt.certificate.where =
        (mechanism_.pilot + 1 + static_cast<int>(index(static_cast<std::size_t>(creases - 1)))) %
        creases;
  }

  enum Sheets { any, reversing, meeting };
  struct Kind {
    const char* name;
    Sheets of;
    void (Spoiler::*spoil)(Certified&);
  };
  const std::vector<Kind> kinds_ = {
      {"a crease's angle, by more than its box", any, &Spoiler::spoil_crease},
      {"a ball joint, by more than its box", any, &Spoiler::spoil_ball},
      {"a length: a vertex moved by 0.01 to 0.4 mm", any, &Spoiler::spoil_length},
      {"the mirror image in one interval", any, &Spoiler::take_mirror_image},
      {"another sheet's intervals", any, &Spoiler::take_another_sheets},
      {"an interval left out", any, &Spoiler::leave_a_gap},
      {"a join moved", any, &Spoiler::move_a_join},
      {"no contact, where panels meet", meeting, &Spoiler::claim_no_contact},
      {"on to D past the reversal", reversing, &Spoiler::go_on_to_d},
      {"on by 0.001 to 0.1 deg past the reversal", reversing, &Spoiler::go_on_a_little},
      {"the closing interval as a good one", reversing, &Spoiler::call_the_closing_interval_good},
      {"another diagonal's reversal", reversing, &Spoiler::name_another_diagonal},
      {"a crease's event instead of the reversal", reversing, &Spoiler::name_a_crease}};

  const schema::Campaign& campaign_;
  const solver::Model& model_;
  const solver::Mechanism& mechanism_;
  const std::vector<Certified> all_;
  std::array<std::vector<std::size_t>, 3> sheets_;
  std::mt19937 random_;
  std::size_t next_ = 0;
  std::map<std::string, std::map<std::string, int>> refusals_;
};

bool spoil(const schema::Campaign& campaign, int times, std::size_t sheets) {
  search::DrawEvaluator evaluator(campaign);
  const solver::Model model = search::model_of(campaign);
  solver::Certifier certifier(model), with_contact(model, true);
  std::vector<Certified> all;
  for (std::uint64_t lo = 0; all.size() < sheets; lo += evaluator.largest_block()) {
    std::uint64_t draw = lo;
    for (const solver::Verdict& verdict : evaluator.judge({lo, lo + evaluator.largest_block()})) {
      if (all.size() < sheets && verdict.deploys_from_sample >= campaign.threshold_sample()) {
        Certified one;
        one.vertices_mm =
            campaign.pattern.base.sheet.vertices_mm + search::shifts_of_draw(campaign, draw);
        one.deploys_from_deg = verdict.deploys_from_sample * campaign.sample_deg;
        one.certificate = certifier.certify(one.vertices_mm, one.deploys_from_deg);
        const double to_deg = one.certificate.certified_deg();
        one.meets = with_contact.certify(one.vertices_mm, to_deg).end == CertificateEnd::contact;
        all.push_back(std::move(one));
      }
      ++draw;
    }
  }
  Spoiler spoiler(campaign, model, std::move(all));
  bool good = true;
  for (int k = 0; k < times; ++k) good = spoiler.spoil_one() && good;
  fmt::print("{}: {} spoilt certificates of {} sheets\n| spoilt | refused because | times |\n",
             campaign.name, times, sheets);
  spoiler.print();
  return good;
}

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "spoilt_certificates TIMES SHEETS CAMPAIGN...\n");
    return 2;
  }
  bool good = true;
  for (int k = 3; k < argc; ++k) {
    good = misalign::spoil(misalign::schema::read_campaign_file(argv[k]), std::stoi(argv[1]),
                           std::stoul(argv[2])) &&
           good;
  }
  return good ? 0 : 1;
}
