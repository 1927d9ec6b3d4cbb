// Tables of materials and hinges: rows follow from what their sources say, names stand for the
// numbers of their rows, and what is recorded is read again as the same design.
#include "schema/pattern/material_table.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "schema/files/output_file.hpp"
#include "schema/pattern/design_json.hpp"
#include "schema/pattern/hinge_table.hpp"
#include "tests/folder.hpp"
#include "tests/schema/schema_agreement.hpp"

namespace misalign::schema {
namespace {

Design design_of(const Json& value) {
  InputFaults faults;
  const Design design = read_design(value, "design", faults);
  for (const std::string& sentence : faults.sentences()) ADD_FAILURE() << sentence;
  return design;
}

// The only fault of a design.
std::string fault_of(const Json& value) {
  InputFaults faults;
  read_design(value, "design", faults);
  EXPECT_EQ(faults.count(), 1u) << value;
  return faults.none() ? "" : faults.sentences().front();
}

const MaterialRow& material_row(std::string_view name) {
  const MaterialRow* row = find_material(name);
  if (!row) throw std::runtime_error("no row " + std::string(name));
  return *row;
}

void expect_holds(const std::string& sentence, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(sentence.find(part), std::string::npos) << part << " in: " << sentence;
  }
}

TEST(MaterialTable, NamesAreUniqueAndHaveSources) {
  std::vector<std::string> names = material_names(), sources;
  for (const std::string& name : hinge_names()) names.push_back(name);
  for (const MaterialRow& row : material_table()) sources.emplace_back(row.source);
  for (const HingeRow& row : hinge_table()) sources.emplace_back(row.source);
  const std::set<std::string> unique(names.begin(), names.end());
  EXPECT_EQ(unique.size(), names.size());
  // Bars divide names in completions and cells in tables; colons and quotes are zsh's.
  for (const std::string& name : names) EXPECT_EQ(name.find_first_of("|:\"\\"), std::string::npos);
  for (const std::string& source : sources) {
    EXPECT_GE(source.size(), 20u) << source;
    EXPECT_EQ(source.find_first_of("|\n"), std::string::npos) << source;
  }
}

TEST(MaterialTable, RowsAreWithinTheLimitsOfMaterialsAndDesigns) {
  for (Json row : material_table_json()) {
    row.erase("source");
    EXPECT_EQ(complaint(material_schema(), row), "");
    const Design design = design_of({{"material", row}});
    EXPECT_EQ(with(material_json(*design.material), "/strength_mpa", row["strength_mpa"]), row);
  }
  for (const HingeRow& row : hinge_table()) {
    Design design;
    design.take_hinge(row);
    for (const DesignNumber& number : design_numbers()) {
      if (const std::optional<double>& value = design.*number.number) {
        EXPECT_GE(*value, number.least) << row.name;
        EXPECT_LE(*value, number.most) << row.name;
      }
    }
    if (row.film) design_of({{"hinges", {{"film", film_json(*row.film)}}}});
  }
}

// The material of designs without one has a name, too.
TEST(MaterialTable, HasTheDefaultMaterial) {
  const Material material = *design_of({{"material", "aluminium"}}).material;
  Material expected;
  expected.crease = CreaseCut::cut;
  EXPECT_EQ(material_json(material), material_json(expected));
}

// Short-term strengths and factors as the sources have them; rows have two or three digits.
TEST(MaterialTable, StrengthsAreSharesOfThoseOfTheSources) {
  struct Share {
    const char* name;
    double short_mpa, factor;
  };
  constexpr double kPsi_mpa = 0.00689476;
  for (const auto& [name, short_mpa, factor] :
       {Share{"aluminium 5052-H32", 193, 2. / 3}, Share{"aluminium 6061-T6", 276, 2. / 3},
        Share{"birch plywood", 29, 0.6}, Share{"MDF", 23, 0.2}, Share{"acrylic", 1500, kPsi_mpa},
        Share{"polypropylene", 10, 1 / 1.6}, Share{"PETG", 53, 0.15}, Share{"PLA", 50, 0.15},
        Share{"carbon laminate", 40 / 10.3e3 * 69.7e3, 0.55}}) {
    EXPECT_NEAR(*material_row(name).strength_mpa, short_mpa * factor, 0.01 * short_mpa * factor)
        << name;
  }
  // The share of PLA and PETG lies between those of plastics with a source.
  EXPECT_LT(*material_row("acrylic").strength_mpa / 75, 0.15);
  EXPECT_GT(*material_row("polypropylene").strength_mpa / 36, 0.15);
}

// Plies of T300/5208 (Tsai and Hahn) at 0, 45, 90 and -45 degrees, whose stiffness matrices are
// turned and added; the compliance of the sum has E and Poisson's ratio.
TEST(MaterialTable, CarbonLaminateIsQuasiIsotropic) {
  constexpr double kAlong = 181, kAcross = 10.3, kShear = 7.17, kPoisson = 0.28;
  Eigen::Matrix3d compliance;
  compliance << 1 / kAlong, -kPoisson / kAlong, 0, -kPoisson / kAlong, 1 / kAcross, 0, 0, 0,
      1 / kShear;
  const Eigen::Matrix3d ply = compliance.inverse();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const double angle : {0., 0.25, 0.5, 0.75}) {
    const double c = std::cos(angle * std::numbers::pi), s = std::sin(angle * std::numbers::pi);
    Eigen::Matrix3d turn;  // strains of the ply from those of the plate
    turn << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
    sum += turn.transpose() * ply * turn / 4;
  }
  const Eigen::Matrix3d plate = sum.inverse();
  EXPECT_NEAR(plate(0, 0), plate(1, 1), 1e-12);
  const MaterialRow& row = material_row("carbon laminate");
  EXPECT_NEAR(row.e_gpa, 1 / plate(0, 0), 0.05);
  EXPECT_NEAR(row.poisson, -plate(0, 1) / plate(0, 0), 0.005);
}

// Equal amounts of both directions: Young's moduli are means, and so are the stiffnesses between
// them. Yellow birch in the Wood Handbook: E_T is 0.05 E_L, and Poisson's ratio LT is 0.451.
TEST(MaterialTable, BirchIsCrossed) {
  constexpr double kShare = 0.05, kLongitudinal = 0.451;
  const MaterialRow& row = material_row("birch plywood");
  EXPECT_NEAR(row.e_gpa, (12.737 + 4.763) / 2, 1e-9);  // bending of 6.5 mm along and across, GPa
  EXPECT_NEAR(row.poisson, kLongitudinal * kShare / ((1 + kShare) / 2), 0.005);
}

TEST(HingeTable, HasFilmsAndPinsOfTheSources) {
  // E t^3 / 12 L; the first is the manual's, 0.026.
  EXPECT_NEAR(find_hinge("polyimide film 0.05 mm")->film->stiffness_n_mm_per_mm(), 0.026, 5e-4);
  EXPECT_NEAR(find_hinge("polyester film 0.1 mm")->film->stiffness_n_mm_per_mm(),
              4900 * 1e-3 / (12 * 2), 1e-12);
  struct Pin {
    const char* name;
    double most_mu;
  };
  for (const auto& [name, mu] :
       {Pin{"steel pin 1 mm in steel, dry", 0.7}, Pin{"steel pin 1 mm in steel, greased", 0.1},
        Pin{"steel pin 1 mm in polyamide, dry", 0.45},
        Pin{"steel pin 1 mm in polyamide, greased", 0.1}, Pin{"steel pin 1 mm in PTFE", 0.22}}) {
    EXPECT_DOUBLE_EQ(*find_hinge(name)->pin_friction_mm, mu * 0.5) << name;
  }
  EXPECT_DOUBLE_EQ(*find_hinge("printed pin hinge")->play_mm, (0.3 + 0.5) / 2 / 2);
}

TEST(MaterialTable, SchemasHaveItsNames) {
  Json names = material_names();
  const Json choices =
      campaign_schema().at(Pointer("/properties/design/properties/material/anyOf"));
  EXPECT_EQ(choices[1]["enum"], names);
  names.push_back(nullptr);
  EXPECT_EQ(choices[0]["properties"]["like"]["enum"], names);
  EXPECT_EQ(material_schema()["properties"]["like"]["enum"], names);
  Json hinges = hinge_names();
  hinges.push_back(nullptr);
  EXPECT_EQ(
      campaign_schema().at(Pointer("/properties/design/properties/hinges/properties/like/enum")),
      hinges);
}

// A recorded design has the name and the numbers, and reads as the same design.
TEST(MaterialTable, RecordedDesignsReadAsTheSame) {
  std::vector<Json> designs;
  for (const std::string& name : material_names()) {
    designs.push_back({{"material", name}});
    designs.push_back({{"material", {{"like", name}, {"e_gpa", 12}}}});
  }
  for (const std::string& name : hinge_names()) {
    designs.push_back({{"hinges", {{"like", name}}}});
    designs.push_back({{"hinges", {{"like", name}, {"friction_n_mm_per_mm", 0}}}});
    designs.push_back({{"hinges", {{"like", name}, {"kind", "dash"}, {"pin_friction_mm", 0}}}});
  }
  for (const Json& design : designs) {
    const Design read = design_of(design);
    const Json recorded = explicit_design_json(read);
    EXPECT_EQ(recorded.dump().find("\"like\""), std::string::npos) << "numbers alone hold";
    const Design again = design_of(recorded);
    EXPECT_EQ(explicit_design_json(again), recorded);
    EXPECT_EQ(design_json(again), design_json(read));
    // Zero and none are one, except beside a film, which gives a friction where there is none.
    EXPECT_EQ(again.friction_n_mm_per_mm.value_or(0), read.friction_n_mm_per_mm.value_or(0));
    if (read.film) {
      EXPECT_EQ(again.friction_n_mm_per_mm, read.friction_n_mm_per_mm) << design;
    }
    EXPECT_EQ(again.material, read.material) << design;
    EXPECT_EQ(again.hinge_name, read.hinge_name) << design;
  }
}

TEST(MaterialTable, ObjectsOverrideSingleNumbers) {
  const auto material_of = [](const Json& value) {
    return material_json(*design_of({{"material", value}}).material);
  };
  Json expected = material_of("birch plywood");
  EXPECT_EQ(material_of({{"like", "birch plywood"}}), expected);
  EXPECT_EQ(expected["name"], "birch plywood");
  expected["e_gpa"] = 9.5;
  expected["name"] = "like birch plywood";
  EXPECT_EQ(material_of({{"like", "birch plywood"}, {"e_gpa", 9.5}}), expected);
  expected["name"] = "mine";
  expected.erase("strength_mpa");
  EXPECT_EQ(
      material_of(
          {{"like", "birch plywood"}, {"e_gpa", 9.5}, {"name", "mine"}, {"strength_mpa", nullptr}}),
      expected);
  // A name alone is a label, as ever.
  EXPECT_EQ(material_of({{"name", "birch plywood"}}),
            with(material_json({}), "/name", "birch plywood"));
}

TEST(MaterialTable, OptionsNameRowsOrFiles) {
  EXPECT_EQ(named_material("MDF"), *design_of({{"material", "MDF"}}).material);
  const Folder folder("material");
  const std::string file = folder.file("oak.json");
  write_text_file(file, R"({"like": "MDF", "e_gpa": 11})");
  Material expected = named_material("MDF");
  expected.e_gpa = 11;
  expected.name = "like MDF";
  EXPECT_EQ(named_material(file), expected);
  try {
    named_material("birchwood");
    ADD_FAILURE() << "birchwood";
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_request);
    expect_holds(error.what(), {"material=birchwood", "no file", "misalign config --materials"});
  }
}

TEST(MaterialTable, WrongNamesGetNearOnes) {
  for (const Json& at :
       {Json{{"material", "plywood"}}, Json{{"material", {{"like", "Plywood"}}}}}) {
    expect_holds(fault_of(at), {"design.material", "is no material of the table",
                                "did you mean birch plywood?", "misalign config --materials"});
  }
  expect_holds(fault_of({{"material", "alumin"}}),
               {"did you mean aluminium or aluminium 5052-H32 or aluminium 6061-T6?"});
  expect_holds(fault_of({{"material", "pla"}}), {"did you mean PLA?"});
  expect_holds(fault_of({{"material", "aluminum"}}), {"did you mean aluminium?"});
  EXPECT_EQ(fault_of({{"material", "unobtainium"}}).find("did you mean"), std::string::npos);
  expect_holds(fault_of({{"material", {{"like", 7}}}}), {"design.material.like = 7"});
  expect_holds(fault_of({{"hinges", {{"like", "polyimid"}}}}),
               {"design.hinges.like", "did you mean polyimide film 0.05 mm?",
                "misalign config --materials"});
  expect_holds(fault_of({{"hinges", {{"like", 7}}}}), {"design.hinges.like = 7"});
}

TEST(HingeTable, GivesWhatTheDesignDoesNotSay) {
  const HingeRow& film = *find_hinge("polyester film 0.1 mm");
  const Design named = design_of({{"hinges", {{"like", "polyester film 0.1 mm"}}}});
  EXPECT_EQ(film_json(*named.film), film_json(*film.film));
  EXPECT_EQ(named.hinge_kind, CreaseCut::film);
  EXPECT_FALSE(named.friction_n_mm_per_mm || named.pin_friction_mm || named.play_mm);
  const Design longer = design_of({{"hinges",
                                    {{"like", "polyester film 0.1 mm"},
                                     {"film", {{"length_mm", 3}}},
                                     {"friction_n_mm_per_mm", 0.01},
                                     {"kind", "score"}}}});
  EXPECT_EQ(longer.film->length_mm, 3);
  EXPECT_EQ(longer.film->e_gpa, film.film->e_gpa);
  EXPECT_EQ(longer.friction_n_mm_per_mm, 0.01);
  EXPECT_EQ(longer.hinge_kind, CreaseCut::score);
  const Json printed = {{"like", "printed pin hinge"}};
  EXPECT_EQ(design_of({{"hinges", printed}}).play_mm, 0.2);
  EXPECT_EQ(design_of({{"hinges", printed}, {"play_mm", 0.05}}).play_mm, 0.05);
  // Hinges without a film complete none.
  InputFaults faults;
  read_design({{"hinges", {{"like", "printed pin hinge"}, {"film", {{"length_mm", 3}}}}}}, "design",
              faults);
  EXPECT_EQ(faults.count(), 2u) << "thickness_mm and e_gpa are needed";
}

// Named hinges of an option are other hinges than the file's; an option's number is of the same.
TEST(HingeTable, OptionsReplaceTheHingesOfFiles) {
  const Design file =
      design_of({{"hinges", {{"like", "polyester film 0.1 mm"}, {"friction_n_mm_per_mm", 0.01}}},
                 {"play_mm", 0.05}});
  Design typed;
  typed.take_hinge(*find_hinge("steel pin 1 mm in PTFE"));
  const Design both = typed.merged_over(file);
  EXPECT_FALSE(both.film || both.friction_n_mm_per_mm);
  EXPECT_EQ(both.pin_friction_mm, 0.11);
  EXPECT_EQ(both.play_mm, 0.05) << "which pins in PTFE have no value for";
  EXPECT_EQ(both.hinge_name, "steel pin 1 mm in PTFE");
  EXPECT_EQ(design_json(typed.merged_over(both)), design_json(both));
  Design number;
  number.friction_n_mm_per_mm = 0.02;
  EXPECT_TRUE(number.merged_over(file).film.has_value());
  EXPECT_EQ(number.merged_over(file).hinge_name, "polyester film 0.1 mm");
}

TEST(MaterialTable, CreasesAreOfHingesThenOfTheMaterial) {
  const auto crease_of = [](const Json& design) {
    return design_of(design).crease_or(CreaseCut::dash);
  };
  EXPECT_EQ(crease_of(Json::object()), CreaseCut::dash);
  EXPECT_EQ(crease_of({{"material", {{"e_gpa", 70}}}}), CreaseCut::dash);
  EXPECT_EQ(crease_of({{"material", "cardboard"}}), CreaseCut::score);
  EXPECT_EQ(crease_of({{"material", {{"like", "cardboard"}, {"crease", "cut"}}}}), CreaseCut::cut);
  EXPECT_EQ(crease_of({{"material", "cardboard"}, {"hinges", {{"kind", "cut"}}}}), CreaseCut::cut);
  EXPECT_EQ(crease_of({{"material", "cardboard"}, {"hinges", {{"like", "glued textile"}}}}),
            CreaseCut::cut);
}

}  // namespace
}  // namespace misalign::schema
