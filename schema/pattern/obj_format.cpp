#include "schema/pattern/obj_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string>
#include <vector>

#include "schema/files/text_lines.hpp"
#include "schema/pattern/plane_mesh.hpp"

namespace misalign::schema {
namespace {

// Returns a word as a number if it is one, otherwise the word.
template <class Number>
Json number_or_text(std::string_view word) {
  const auto number = number_of<Number>(word);
  return number ? Json(*number) : Json(std::string(word));
}

class ObjReader {
 public:
  bool take(const Words& words) {
    const std::string_view what = words[0];
    if (what == "v") {
      Json point = Json::array();
      for (std::size_t k = 1; k < std::min<std::size_t>(words.size(), 4); ++k) {
        point.push_back(number_or_text<double>(words[k]));
      }
      points_.push_back(std::move(point));
    } else if (what == "f") {
      faces_.push_back(corners(words));
    } else if (what == "l") {
      lines_.emplace_back(letter_, corners(words));
    } else if (what == "g" || what == "o" || what == "usemtl") {
      letter_ = letter_of(words.size() > 1 ? words[1] : "");
    }
    // One more than the FOLD reader accepts, which reports it.
    return points_.size() <= 4 * kMostFaces && faces_.size() <= kMostFaces &&
           lines_.size() <= 4 * kMostFaces;
  }

  Json fold() const {
    std::map<std::pair<int, int>, std::string> edges;
    Json others = Json::array();  // lines without two vertices
    const auto add = [&](const Json& a, const Json& b, const std::string& letter) {
      if (!a.is_number_integer() || !b.is_number_integer() || a == b) {
        others.push_back({a, b});
      } else {
        std::string& known = edges[std::minmax(a.get<int>(), b.get<int>())];
        if (known.empty() || letter != "U") known = letter;
      }
    };
    for (const Json& face : faces_) {
      for (std::size_t k = 0; k < face.size(); ++k) add(face[k], face[(k + 1) % face.size()], "U");
    }
    for (const auto& [letter, line] : lines_) {
      for (std::size_t k = 0; k + 1 < line.size(); ++k) add(line[k], line[k + 1], letter);
    }
    Json ends = Json::array(), letters = Json::array();
    for (const auto& [pair, letter] : edges) {
      ends.push_back({pair.first, pair.second});
      letters.push_back(letter);
    }
    for (const Json& other : others) {
      ends.push_back(other);
      letters.push_back("U");
    }
    Json mesh = {
        {"vertices_coords", points_}, {"edges_vertices", ends}, {"edges_assignment", letters}};
    if (!faces_.empty()) mesh["faces_vertices"] = faces_;
    return mesh;
  }

 private:
  // Reads "7", "7/1/3" or "-1", counted from 1 or from the end.
  Json corners(const Words& words) const {
    Json vertices = Json::array();
    for (std::size_t k = 1; k < words.size(); ++k) {
      Json vertex = number_or_text<int>(words[k].substr(0, words[k].find('/')));
      if (vertex.is_number_integer()) {
        const int number = vertex.get<int>();
        vertex = number > 0 ? number - 1 : static_cast<int>(points_.size()) + number;
      }
      vertices.push_back(std::move(vertex));
    }
    return vertices;
  }

  static std::string letter_of(std::string_view name) {
    const auto begins = [&](std::string_view word) {
      return std::ranges::equal(name.substr(0, word.size()), word,
                                [](unsigned char a, char b) { return std::tolower(a) == b; });
    };
    return begins("mountain") ? "M" : begins("valley") ? "V" : "U";
  }

  Json points_ = Json::array(), faces_ = Json::array();
  std::vector<std::pair<std::string, Json>> lines_;
  std::string letter_ = "U";
};

}  // namespace

bool is_obj(std::string_view text) {
  constexpr std::array<std::string_view, 10> kWords = {"v", "vn", "vt",     "f",      "l",
                                                       "g", "o",  "usemtl", "mtllib", "s"};
  bool is = false;
  each_line(text, [&](const Words& words) {
    is = std::ranges::find(kWords, words[0]) != kWords.end();
    return false;
  });
  return is;
}

Json obj_as_fold(std::string_view text) {
  ObjReader reader;
  each_line(text, [&](const Words& words) { return reader.take(words); });
  return reader.fold();
}

}  // namespace misalign::schema
