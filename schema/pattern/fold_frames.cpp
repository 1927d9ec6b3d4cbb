#include "schema/pattern/fold_frames.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace misalign::schema {
namespace {

constexpr const char* kCoordinates = "vertices_coords";
constexpr std::size_t kLongestLine = 32;  // parents in a line; a circle of them is longer

bool is_of_class(const Json& frame, const char* name) {
  const auto classes = frame.find("frame_classes");
  return classes != frame.end() && classes->is_array() &&
         std::find(classes->begin(), classes->end(), name) != classes->end();
}

class Frames {
 public:
  explicit Frames(const Json& fold) : fold_(fold) {
    const auto frames = fold.find("file_frames");
    if (frames != fold.end() && frames->is_array()) frames_ = &*frames;
  }

  // Returns the number of the first frame that `is` accepts and that has coordinates; 0: none.
  template <class Is>
  std::size_t first(const Is& is) const {
    for (std::size_t k = 1; k <= count(); ++k) {
      if (has_coordinates(k) && is(at(k))) return k;
    }
    return 0;
  }

  // Returns whether this is a frame with coordinates, its own or inherited.
  bool has_coordinates(std::size_t k) const {
    return at(k).is_object() && std::ranges::any_of(line_of(k), [](const Json* frame) {
             return frame->contains(kCoordinates);
           });
  }

  std::size_t count() const { return frames_ ? frames_->size() : 0; }
  const Json& at(std::size_t k) const { return k == 0 ? fold_ : (*frames_)[k - 1]; }

  Json with_inherited(std::size_t k) const {
    Json whole = Json::object();
    for (const Json* frame : line_of(k)) {
      for (const auto& [key, value] : frame->items()) {
        if (key != "file_frames") whole[key] = value;
      }
    }
    return whole;
  }

 private:
  // Returns a frame and the frames that it inherits from, the oldest first.
  std::vector<const Json*> line_of(std::size_t k) const {
    std::vector<const Json*> line;
    for (std::optional<std::size_t> next = k; next && line.size() < kLongestLine;) {
      const Json& frame = at(*next);
      if (!frame.is_object()) break;
      line.push_back(&frame);
      next = parent_of(frame);
    }
    std::ranges::reverse(line);
    return line;
  }

  std::optional<std::size_t> parent_of(const Json& frame) const {
    const auto inherits = frame.find("frame_inherit"), parent = frame.find("frame_parent");
    if (inherits == frame.end() || *inherits != true) return std::nullopt;
    if (parent == frame.end() || !parent->is_number_integer()) return std::nullopt;
    const auto number = parent->get<std::int64_t>();
    if (number < 0 || number > static_cast<std::int64_t>(count())) return std::nullopt;
    return static_cast<std::size_t>(number);
  }

  const Json& fold_;
  const Json* frames_ = nullptr;
};

}  // namespace

bool is_fold(const Json& document) {
  if (!document.is_object()) return false;
  return std::ranges::any_of(document.items(), [](const auto& entry) {
    const std::string& key = entry.key();
    return key.starts_with("vertices_") || key.starts_with("edges_") || key.starts_with("faces_") ||
           key == "file_spec" || key == "file_frames";
  });
}

std::optional<FoldFrame> crease_pattern_frame(const Json& fold) {
  const auto is_pattern = [](const Json& frame) { return is_of_class(frame, "creasePattern"); };
  const auto is_folded = [](const Json& frame) { return is_of_class(frame, "foldedForm"); };
  const bool has_coordinates = fold.contains(kCoordinates);
  if (has_coordinates && (is_pattern(fold) || !is_folded(fold))) return std::nullopt;
  const Frames frames(fold);
  std::size_t k = frames.first(is_pattern);
  if (k == 0 && !has_coordinates) {
    k = frames.first([&](const Json& frame) { return !is_folded(frame); });
  }
  if (k == 0) return std::nullopt;
  return FoldFrame{frames.with_inherited(k), k};
}

std::vector<FoldFrame> folded_form_frames(const Json& fold) {
  std::vector<FoldFrame> found;
  if (!fold.is_object()) return found;
  const Frames frames(fold);
  for (std::size_t k = 0; k <= frames.count(); ++k) {
    if (frames.has_coordinates(k) && is_of_class(frames.at(k), "foldedForm")) {
      found.push_back({frames.with_inherited(k), k});
    }
  }
  return found;
}

}  // namespace misalign::schema
