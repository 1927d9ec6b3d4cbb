// Sheets that are met again and again, in any order: against sorting all of them.
#include "search/splitting/found_candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace misalign::search {
namespace {

struct Meeting {
  Origin origin;
  double sheet;  // its only shift

  friend auto operator<=>(const Meeting&, const Meeting&) = default;
};

schema::Candidate candidate_of(const Meeting& meeting) {
  schema::Candidate candidate{};
  candidate.shifts_mm = Eigen::Matrix2Xd::Constant(2, 1, meeting.sheet);
  return candidate;
}

// 400 meetings of 60 sheets at three levels.
std::vector<Meeting> some_meetings() {
  std::mt19937 random(7);
  std::vector<Meeting> meetings;
  const auto below = [&](std::uint32_t most) {
    return static_cast<std::uint32_t>(random() % most);
  };
  for (std::uint32_t particle = 0; particle < 400; ++particle) {
    meetings.push_back({{5, particle / 150, below(4), particle}, 0.1 * below(60)});
  }
  return meetings;
}

TEST(FoundCandidates, AreThoseThatWereMetFirstWhateverTheOrder) {
  std::vector<Meeting> meetings = some_meetings();
  std::map<double, Origin> first;
  for (const Meeting& meeting : meetings) {
    const auto [at, is_new] = first.try_emplace(meeting.sheet, meeting.origin);
    if (!is_new) at->second = std::min(at->second, meeting.origin);
  }
  std::vector<Meeting> expected;
  std::vector<std::uint64_t> met(3);
  for (const auto& [sheet, origin] : first) {
    expected.push_back({origin, sheet});
    ++met[origin.level];
  }
  std::ranges::sort(expected);
  std::mt19937 random(8);
  for (const std::uint64_t most :
       {kAllSheets, std::uint64_t{1000}, std::uint64_t{9}, std::uint64_t{1}, std::uint64_t{0}}) {
    std::ranges::shuffle(meetings, random);
    FoundCandidates found(most);
    for (const Meeting& meeting : meetings) found.add(meeting.origin, candidate_of(meeting));
    std::vector<schema::LevelCount> levels(3);
    found.count(levels);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(levels[k].met, met[k]) << k << " " << most;
    const std::vector<FoundCandidate> kept = found.take();
    ASSERT_EQ(kept.size(), std::min<std::uint64_t>(most, expected.size()));
    for (std::size_t k = 0; k < kept.size(); ++k) {
      EXPECT_EQ(kept[k].origin, expected[k].origin);
      EXPECT_EQ(kept[k].candidate.shifts_mm(0, 0), expected[k].sheet);
    }
  }
}

}  // namespace
}  // namespace misalign::search
