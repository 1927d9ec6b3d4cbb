// Words for fillings: their state at rest by every place that shows it, and which springs are
// equal.
#include "schema/pattern/fill_words.hpp"

#include <gtest/gtest.h>

#include "schema/files/user_error.hpp"
#include "schema/pattern/judging_fill.hpp"

namespace misalign::schema {
namespace {

using solver::Fill;
using solver::RubberPlates;
using solver::SingleSpring;
using solver::Springs;

const SingleSpring kOfItsRate{{8, 14}, 12, {}}, kOfItsLength{{8, 14}, 50, 110};

Springs springs_with(const SingleSpring& spring) {
  Springs springs;
  springs.single = {spring};
  return springs;
}

TEST(FillWords, TheStateAtRestIsOneForAllWords) {
  RubberPlates cut_out, stretched;
  cut_out.cut_outs = {{0, {0.9, 0.9}}};
  stretched.prestretch = 1.1;
  stretched.rest_deg = 60;
  Springs preloaded = springs_with(kOfItsLength);
  preloaded.preload.each_n = 3;
  const struct {
    Fill fill;
    const char *state, *rest;
  } kSaid[] = {
      {Springs{}, "relaxed", "relaxed when flat"},
      {springs_with(kOfItsRate), "relaxed", "relaxed when flat"},
      {springs_with(kOfItsLength), "preloaded", "preloaded by free lengths of their own when flat"},
      {preloaded, "preloaded", "preloaded with 3 N when flat"},
      {RubberPlates{}, "relaxed", "relaxed when flat"},
      {cut_out, "pre-stretched", "pre-stretched by cut-outs of their own when flat"},
      {stretched, "pre-stretched", "pre-stretched by 1.1 at 60°"}};
  for (const auto& [fill, state, rest] : kSaid) {
    EXPECT_EQ(std::string(state_words(fill)), state);
    EXPECT_EQ(rest_words(fill, kDegreeSign), rest);
    EXPECT_NE(filling_words(fill, 8, kDegreeSign).find(rest), std::string::npos);
  }
  EXPECT_EQ(rest_words(stretched, kDegreeWord), "pre-stretched by 1.1 at 60 deg");
}

TEST(FillWords, SpringsThatAllDifferHaveNoCommonRate) {
  const Springs springs = springs_with(kOfItsLength);
  EXPECT_EQ(fill_words(springs, 1), "springs, each with its rate and free length");
  EXPECT_EQ(fill_words(springs, 2), "springs of 50 N/mm, some of other rates or free lengths");
}

TEST(FillWords, EqualSpringsAreThoseOfOneRateOnAllDiagonals) {
  Springs wires, one, rest, others;
  wires.pull_only = true;
  one.on = solver::SpringsOn::one_a_hole;
  rest.rest_deg = 60;
  others.other_rests_deg = {{0, 60}};
  EXPECT_TRUE(are_equal_springs(Springs{}));
  for (const Springs& springs :
       {wires, one, rest, others, springs_with(kOfItsRate), springs_with(kOfItsLength)}) {
    EXPECT_FALSE(are_equal_springs(springs));
  }
  EXPECT_FALSE(are_equal_springs(RubberPlates{}));
  EXPECT_NO_THROW(need_plain_springs(rest, "a test"));
  for (const Springs& springs : {wires, one, others, springs_with(kOfItsRate)}) {
    EXPECT_THROW(need_plain_springs(springs, "a test"), UserError);
  }
  // A rate of its own changes no rest, a free length does.
  EXPECT_TRUE(drives_to_flat(springs_with(kOfItsRate)));
  EXPECT_TRUE(drives_to_flat(one));
  EXPECT_FALSE(can_judge(one) || can_judge(springs_with(kOfItsRate)));
  EXPECT_TRUE(can_judge(wires));
  for (const Fill& fill :
       {Fill(rest), Fill(others), Fill(springs_with(kOfItsLength)), Fill(solver::NoFill{})}) {
    EXPECT_FALSE(drives_to_flat(fill));
  }
}

}  // namespace
}  // namespace misalign::schema
