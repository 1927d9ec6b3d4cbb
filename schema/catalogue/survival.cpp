#include "schema/catalogue/survival.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "schema/catalogue/weighted_count.hpp"

namespace misalign::schema {
namespace {

// A tail has kLeastRows to kMostRows rows, and at most kMostShare of all.
constexpr double kMostRows = 20, kLeastRows = 8, kMostShare = 0.25;
constexpr double kFewestRows = 2;  // least effective number of rows of a share
constexpr double kNormal95 = 1.96;

double rad(double deg) { return deg * std::numbers::pi / 180; }

}  // namespace

void Survival::add(int deploys_from_sample, const WeightedCount& draws) {
  at_[std::clamp(deploys_from_sample, 0, last_sample_)] += draws;
  all_ += draws;
}

WeightedCount Survival::from(int sample) const {
  WeightedCount sum;
  for (auto at = at_.lower_bound(sample); at != at_.end(); ++at) sum += at->second;
  return sum;
}

std::optional<int> Survival::sample_of_share(double wanted) const {
  if (!(wanted * all_.effective() >= kFewestRows)) return std::nullopt;
  WeightedCount deeper;
  for (auto at = at_.rbegin(); at != at_.rend(); ++at) {
    deeper += at->second;
    if (share(deeper, all_) >= wanted) return at->first;
  }
  return 0;
}

double Survival::ln_t(double deg) const {
  const double most_deg = std::min(deg, 180 - sample_deg_ / 2);
  return std::log(std::tan(rad(most_deg) / 2));
}

// Fits the tail. A draw's fault is taken to lie midway between its last sample and the next. The
// deepest samples are taken whole until there are enough rows.
std::optional<Survival::Tail> Survival::tail() const {
  const double most = std::min(kMostRows, kMostShare * all_.effective());
  if (most < kLeastRows) return std::nullopt;
  WeightedCount rows;
  int first = 0;
  for (auto at = at_.rbegin(); at != at_.rend() && at->first > 0; ++at) {
    WeightedCount more = rows;
    more += at->second;
    if (rows.effective() >= kLeastRows && more.effective() > most) break;
    rows = more;
    first = at->first;
  }
  if (rows.effective() < kLeastRows) return std::nullopt;
  const double from = ln_t(deg(first));
  double excess = 0;
  for (auto at = at_.lower_bound(first); at != at_.end(); ++at) {
    excess += at->second.draws * (ln_t(deg(at->first) + sample_deg_ / 2) - from);
  }
  if (!(excess > 0)) return std::nullopt;
  return Tail{first, share(rows, all_), rows.effective(),
              (1 - 1 / rows.effective()) * rows.draws / excess};
}

double Survival::guessed(const Tail& tail, double distance) {
  return tail.share * std::exp(-tail.power * distance);
}

std::optional<SurvivalGuess> Survival::guess(int sample) const {
  const auto tail = this->tail();
  if (!tail || sample < tail->first_sample) return std::nullopt;
  const double distance = ln_t(deg(sample)) - ln_t(deg(tail->first_sample));
  const double slope = tail->power * distance;
  const double factor = std::exp(kNormal95 * std::sqrt((1 + slope * slope) / tail->rows));
  const double rate = guessed(*tail, distance);
  return SurvivalGuess{rate, rate / factor, std::min(rate * factor, 1.0)};
}

std::optional<int> Survival::sample_to_try(double wanted) const {
  if (const auto seen = sample_of_share(wanted)) return seen;
  const auto tail = this->tail();
  if (!tail) return std::nullopt;
  int sample = tail->first_sample;
  if (wanted > tail->share) return sample_of_share(tail->share);
  while (sample < last_sample_) {
    const double distance = ln_t(deg(sample + 1)) - ln_t(deg(tail->first_sample));
    if (guessed(*tail, distance) < wanted) break;
    ++sample;
  }
  return sample;
}

Survival read_survival(SQLite::Database& database) {
  return reading(database, [&] {
    SQLite::Statement path(database,
                           "SELECT json_extract(configuration, '$.path.sample_deg'), "
                           "json_extract(configuration, '$.path.end_deg') FROM campaign");
    if (!path.executeStep()) throw damaged(database, "it names no campaign");
    const double sample_deg = path.getColumn(0).getDouble(),
                 end_deg = path.getColumn(1).getDouble();
    if (!(sample_deg > 1e-3 && end_deg >= sample_deg && end_deg <= 180)) {
      throw damaged(database, "its path has no samples");
    }
    const int last = static_cast<int>(std::lround(end_deg / sample_deg));
    Survival survival(sample_deg, last);
    SQLite::Statement rows(database,
                           "SELECT deploys_from_sample, count(*), stands_for FROM fault_sample "
                           "GROUP BY 1, 3");
    while (rows.executeStep()) {
      survival.add(
          static_cast<int>(std::clamp<std::int64_t>(rows.getColumn(0).getInt64(), 0, last)),
          sampled_rows(database, rows.getColumn(1), rows.getColumn(2)));
    }
    return survival;
  });
}

}  // namespace misalign::schema
