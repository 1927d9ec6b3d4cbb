// Finds the crease pattern among the frames of a FOLD file.
#pragma once

#include <optional>
#include <vector>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Returns whether a document is a FOLD object, even one with only metadata.
bool is_fold(const Json& document);

/// A frame of a file, with its inherited keys.
struct FoldFrame {
  Json frame;
  std::size_t number;  ///< number in file_frames, from 1; 0: the key frame
};

/// Finds the frame of the crease pattern; none: the key frame. If that has no coordinates or is a
/// folded form, it is the first frame of class creasePattern; if that has no coordinates or does
/// not exist, the first frame with coordinates that is no folded form.
std::optional<FoldFrame> crease_pattern_frame(const Json& fold);

/// Finds the frames of class foldedForm that have coordinates, in their order.
std::vector<FoldFrame> folded_form_frames(const Json& fold);

}  // namespace misalign::schema
