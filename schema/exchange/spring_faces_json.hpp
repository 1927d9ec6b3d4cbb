// Writes the faces of springs as JSON and as words.
#pragma once

#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/contact/spring_faces.hpp"

namespace misalign::schema {

/// Each spring's face, height and turn, ascending diagonals; [] where no layers keep springs apart.
Json spring_faces_json(const solver::Mechanism& mechanism, const solver::SpringFaces& faces);

/// Sentences: what is clear of what, up to where, the smallest clearance, and what heights do to
/// the springs; or that no layers keep springs apart.
std::vector<std::string> faces_sentences(const solver::SpringFaces& faces);

/// "above".
const char* word_of(solver::SheetFace face);
/// "mid-plane", or "3.25 mm above".
std::string height_words(const solver::HungSpring& spring);

}  // namespace misalign::schema
