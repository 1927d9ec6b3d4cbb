#include "schema/exchange/spring_faces_json.hpp"

#include <fmt/format.h>

#include <cmath>

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {

std::vector<std::string> faces_sentences(const solver::SpringFaces& faces) {
  std::vector<std::string> sentences = {
      fmt::format("Springs of {:g} mm, panels of {:g} mm, folded up to {:.10g}°.",
                  faces.bodies.diameter_mm, faces.bodies.panel_mm, faces.to_deg)};
  if (faces.springs.empty()) {
    sentences.push_back(
        fmt::format("No faces and layers{} keep the springs clear of each other and of panels: "
                    "take thinner springs, or one a hole.",
                    faces.is_proven ? "" : " that were tried"));
    return sentences;
  }
  if (faces.closest) {
    sentences.push_back(
        fmt::format("Nothing meets: the smallest clearance is {:.2f} mm, at {:.3g}°.",
                    faces.closest->clear_mm, faces.closest->pilot_deg));
  }
  if (faces.length_change_mm > 0) {
    sentences.push_back(
        fmt::format("Ends off the mid-plane change lengths by at most {:.2f} mm, with which the "
                    "springs {} the sheet at every angle.",
                    faces.length_change_mm, faces.drives ? "still drive" : "no longer drive"));
  }
  return sentences;
}

const char* word_of(solver::SheetFace face) {
  return face == solver::SheetFace::above ? "above" : "below";
}

std::string height_words(const solver::HungSpring& spring) {
  if (spring.layer == 0) return "mid-plane";
  return fmt::format("{:.2f} mm {}", std::abs(spring.height_mm), word_of(spring.face));
}

Json spring_faces_json(const solver::Mechanism& mechanism, const solver::SpringFaces& faces) {
  const bool has_way = !faces.springs.empty();
  return {{"to_deg", faces.to_deg},
          {"diameter_mm", faces.bodies.diameter_mm},
          {"springs", json_list(faces.springs,
                                [&](const solver::HungSpring& spring) -> Json {
                                  return {{"diagonal", diagonal_label(mechanism, spring.diagonal)},
                                          {"face", word_of(spring.face)},
                                          {"height_mm", spring.height_mm},
                                          {"turn", spring.turn}};
                                })},
          {"least_clearance_mm", faces.closest ? Json(faces.closest->clear_mm) : Json()},
          {"length_change_mm", has_way ? Json(faces.length_change_mm) : Json()},
          {"drives", has_way ? Json(faces.drives) : Json()},
          {"is_proven", faces.is_proven}};
}

}  // namespace misalign::schema
