// Finds the crease pattern among the frames of a FOLD file.
#pragma once

#include <optional>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Whether a document is a FOLD object, if only one of metadata.
bool is_fold(const Json& document);

/// One of a file's frames, with what it inherits.
struct FoldFrame {
  Json frame;
  std::size_t number;  ///< in file_frames, from 1
};

/// None: the crease pattern is the key frame. Where that has no coordinates or is a folded form, it
/// is the first frame of class creasePattern; without coordinates, and where there is none such,
/// the first with coordinates that is no folded form.
std::optional<FoldFrame> crease_pattern_frame(const Json& fold);

}  // namespace misalign::schema
