// Patterns as campaigns name them: perforations that are refused, and labels of vertices.
#include "schema/pattern/pattern_file.hpp"

#include "schema/pattern/vertex_labels.hpp"
#include "tests/schema/campaign_faults.hpp"

namespace misalign::schema {
namespace {

TEST(Perforation, OddSidesAreRefusedByRank) {
  struct Case {
    int rows, columns, rank, equations;
  };
  // Ranks as specified for 3 x 4, 5 x 6 and 7 x 6; transposing a sheet changes none.
  constexpr Case kCases[] = {{3, 4, 11, 12}, {4, 3, 11, 12}, {5, 6, 40, 42},
                             {6, 5, 40, 42}, {7, 6, 64, 66}, {6, 7, 64, 66}};
  for (const Case& c : kCases) {
    for (const char* holes : {"checkerboard-odd", "checkerboard-even"}) {
      const Json patch = {
          {"pattern", {{"rows", c.rows}, {"columns", c.columns}, {"holes", holes}}}};
      expect_fault(with(patch), {"pattern.holes", "rank " + std::to_string(c.rank),
                                 std::to_string(c.equations) + " equations",
                                 std::to_string(c.equations + 1 - c.rank) + " degrees of freedom",
                                 "make rows and columns even"});
    }
  }
}

TEST(Perforation, BadHolesAreRefused) {
  struct Case {
    const char* holes;
    std::vector<std::string> words;
  };
  const Case kCases[] = {
      {"[[0,2]]", {"perimeter", "A3-A4-A11-A10"}},
      {"[[5,5]]", {"perimeter"}},
      {"[[2,0]]", {"perimeter"}},
      {"[[1,2],[1,3]]", {"shares the edge A11-A18"}},
      {"[[1,2],[2,2]]", {"shares the edge A17-A18"}},
      {"[[1,2],[1,4],[2,1],[2,3],[3,2],[3,4],[4,1],[4,3],[1,2]]", {"twice"}},
      {"[[6,2]]", {"[6,2]", "rows 0 to 5"}},
      {"[[2,6]]", {"[2,6]", "columns 0 to 5"}},
      {"[[-1,2]]", {"[-1,2]"}},
      {"[[4294967297,2]]", {"4294967297"}},  // 2^32 + 1 must not become 1
      {"[]", {"no hole"}},
  };
  for (const Case& c : kCases) {
    std::vector<std::string> words = c.words;
    words.push_back("pattern.holes");
    expect_fault(with(Json{{"pattern", {{"holes", Json::parse(c.holes)}}}}), words);
  }
  expect_fault(with(R"({"pattern": {"rows": 2}})"), {"pattern.rows = 2", "at least 3"});
}

// Inner panels that meet at corners only can be too many on odd sheets: there (2.1) counts 2.
TEST(Perforation, TooManyHolesAreRefusedByRank) {
  expect_fault(with(R"({"pattern": {"rows": 3, "columns": 3, "holes": [[1,1]]}})"),
               {"pattern.holes", "degrees of freedom", "rank"});
  expect_fault(with(R"({"pattern": {"rows": 5, "columns": 5, "holes": "checkerboard-even"}})"),
               {"pattern.holes", "degrees of freedom", "rank"});
}

// A correct Miura-ori moves with any perforation: redundant equations hide that a shifted sheet,
// whose equations are independent, is stiff. The solver needs as many equations as unknowns less 1.
TEST(Perforation, TooFewHolesAreRefused) {
  EXPECT_FALSE(faults_of(with(R"({"pattern": {"holes": [[1,2]]}})")).empty());
  EXPECT_FALSE(
      faults_of(with(R"({"pattern": {"holes": [[1,2],[1,4],[2,1],[2,3],[3,2],[3,4],[4,1]]}})"))
          .empty());
  EXPECT_FALSE(
      faults_of(with(R"({"pattern": {"rows": 4, "columns": 4, "holes": [[1,1]]}})")).empty());
}

TEST(Vertices, LabelsAreReadExactly) {
  struct Case {
    const char* label;
    int vertex;
  };
  constexpr Case kCases[] = {
      {"A1", 0},
      {"A10", 9},
      {"A49", 48},
      {"A50", -1},
      {"A0", -1},
      {"A", -1},
      {"", -1},
      {"a1", -1},
      {"B1", -1},
      {"A01", -1},
      {"A-1", -1},
      {"A+1", -1},
      {"A 1", -1},
      {"A1 ", -1},
      {" A1", -1},
      {"A1.0", -1},
      {"A4294967297", -1},
      {"1", -1},
      {"A1e1", -1},
      {"AA1", -1},
      {"A0x1", -1},
      {"A99999999999999999999", -1},
  };
  for (const Case& c : kCases) EXPECT_EQ(vertex_of_label(c.label, 49), c.vertex) << c.label;
  EXPECT_EQ(vertex_of_label(std::string("A1\0", 3), 49), -1);
  for (int v = 0; v < 49; ++v) EXPECT_EQ(vertex_of_label(solver::vertex_label(v), 49), v);
  expect_fault(with(R"({"misalignment": {"vertices": ["A50"]}})"),
               {"misalignment.vertices", "A50"});
}

}  // namespace
}  // namespace misalign::schema
