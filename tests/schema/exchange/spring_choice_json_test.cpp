// Chosen springs as JSON: a design that reads their filling has the same springs.
#include "schema/exchange/spring_choice_json.hpp"

#include <gtest/gtest.h>

#include "schema/pattern/fill_json.hpp"
#include "tests/schema/kit/kit_fixture.hpp"

namespace misalign::schema {
namespace {

TEST(SpringChoiceJson, ItsFillingIsReadAgain) {
  const KitFixture kit(4, 4);
  solver::SpringChoice choice{};
  choice.options.most_rate_n_per_mm = 5;
  choice.options.pull_only = true;
  choice.springs = {{1, 2.5, 101.5}, {2, 5, 98}};
  const Json fill = spring_choice_json(kit.base, kit.mechanism, choice).at("fill");
  InputFaults faults;
  const auto read = read_fill_of(kit.base, fill, "design.fill", faults);
  EXPECT_TRUE(faults.none()) << faults.sentences().front();
  ASSERT_TRUE(read);
  const auto& springs = std::get<solver::Springs>(*read);
  EXPECT_TRUE(springs.pull_only);
  for (int d = 0; d < kit.mechanism.diagonal_count(); ++d) {
    const solver::Diagonal& diagonal = kit.mechanism.diagonals[static_cast<std::size_t>(d)];
    const auto is_its = [&](const solver::SingleSpring& spring) { return spring.is_on(diagonal); };
    ASSERT_EQ(std::ranges::count_if(springs.single, is_its), 1) << d;
    const auto spring = std::ranges::find_if(springs.single, is_its);
    EXPECT_EQ(spring->stiffness_n_per_mm, d == 1 ? 2.5 : d == 2 ? 5 : 0) << d;
    EXPECT_EQ(spring->free_mm.value_or(0), d == 1 ? 101.5 : d == 2 ? 98 : 0) << d;
  }
  choice.springs = {};
  EXPECT_TRUE(spring_choice_json(kit.base, kit.mechanism, choice).at("fill").is_null());
}

}  // namespace
}  // namespace misalign::schema
