#include "schema/exchange/dxf_pen.hpp"

#include <dxflib/dl_dxf.h>
#include <dxflib/dl_writer_ascii.h>
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <string_view>

#include "schema/files/input.hpp"
#include "schema/files/memory_file.hpp"
#include "schema/files/printable.hpp"
#include "schema/files/utf8.hpp"
#include "solver/pattern/half_angle.hpp"

namespace misalign::schema {
namespace {

// Values of $INSUNITS and $MEASUREMENT.
constexpr int kInches = 1, kMillimetres = 4, kImperial = 0, kMetric = 1;
constexpr int kByLayer = 256;
constexpr const char* kStyle = "STANDARD";

[[noreturn]] void refuse(const std::string& why) {
  throw UserError(Cause::failure,
                  "the DXF file cannot be made (" + why + "); free some memory and try again");
}

std::string capitals(std::string name) {
  for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return name;
}

// Escapes words for a TEXT: one line of ASCII, in which %% and ^ would begin a code.
std::string dxf_text(const std::string& words) {
  const std::string line = printable(utf8(words));
  std::string text;
  for (std::string_view rest = line; !rest.empty();) {
    const Utf8Character c = first_character(rest);
    if (c.bytes == 1) {
      text += rest[0];
      if (c.code == '^' || c.code == '%') text += ' ';
    } else {
      text += c.bytes < 4 ? fmt::format("\\U+{:04X}", std::uint32_t{c.code}) : "?";
    }
    rest.remove_prefix(c.bytes);
  }
  return text;
}

class DxfPen {
 public:
  DxfPen(const LineDrawing& drawing, const std::string& path)
      : drawing_(drawing), to_(dxf_.out(path.c_str(), DL_VERSION_2000)) {
    if (!to_) refuse("no file in memory can be opened");
  }

  void write() {
    write_header();
    write_tables();
    write_blocks();
    to_->sectionEntities();
    for (const LineLayer& layer : drawing_.layers) write_layer(layer);
    to_->sectionEnd();
    dxf_.writeObjects(*to_);
    dxf_.writeObjectsEnd(*to_);
    to_->dxfEOF();
    to_->close();
  }

 private:
  // A point from the page's corner, in the drawing's unit.
  Eigen::Vector2d on_page(const Eigen::Vector2d& at_mm) const {
    const Eigen::Vector2d off_mm = at_mm - drawing_.least_mm;
    return {in_unit(off_mm.x(), drawing_.unit), in_unit(off_mm.y(), drawing_.unit)};
  }

  void write_header() {
    const bool is_metric = drawing_.unit == LengthUnit::millimetre;
    const Eigen::Vector2d page = on_page(drawing_.most_mm);
    const auto whole = [&](const char* name, int value) {
      to_->dxfString(9, name);
      to_->dxfInt(70, value);
    };
    const auto corner = [&](const char* name, const Eigen::Vector2d& at) {
      to_->dxfString(9, name);
      to_->dxfReal(10, at.x());
      to_->dxfReal(20, at.y());
    };
    dxf_.writeHeader(*to_);
    whole("$INSUNITS", is_metric ? kMillimetres : kInches);
    whole("$MEASUREMENT", is_metric ? kMetric : kImperial);
    corner("$LIMMIN", Eigen::Vector2d::Zero());
    corner("$LIMMAX", page);
    for (const char* name : {"$EXTMIN", "$EXTMAX"}) {
      corner(name, name[4] == 'M' && name[5] == 'I' ? Eigen::Vector2d(0, 0) : page);
      to_->dxfReal(30, 0);
    }
    to_->sectionEnd();
  }

  void write_tables() {
    constexpr const char* kLine = "CONTINUOUS";
    constexpr double kText_mm = 2.5;
    to_->sectionTables();
    dxf_.writeVPort(*to_);
    to_->tableLinetypes(3);
    for (const char* name : {"BYBLOCK", "BYLAYER", kLine}) {
      dxf_.writeLinetype(*to_, DL_LinetypeData(name, name, 0, 0, 0.0));
    }
    to_->tableEnd();
    to_->tableLayers(static_cast<int>(drawing_.layers.size()) + 1);
    dxf_.writeLayer(*to_, DL_LayerData("0", 0), DL_Attributes("", kBlack.aci, 0, kLine, 1.0));
    for (const LineLayer& layer : drawing_.layers) {
      dxf_.writeLayer(*to_, DL_LayerData(capitals(layer.name), 0, layer.use == LayerUse::hidden),
                      DL_Attributes("", layer.colour.aci, 0, kLine, 1.0));
    }
    to_->tableEnd();
    to_->tableStyle(1);
    dxf_.writeStyle(*to_, DL_StyleData(kStyle, 0, 0.0, 1.0, 0.0, 0, kText_mm, "txt", ""));
    to_->tableEnd();
    dxf_.writeView(*to_);
    dxf_.writeUcs(*to_);
    to_->tableAppid(1);
    dxf_.writeAppid(*to_, "ACAD");
    to_->tableEnd();
    dxf_.writeDimStyle(*to_, kText_mm, 0.5 * kText_mm, 0.25 * kText_mm, 0.25 * kText_mm, kText_mm);
    dxf_.writeBlockRecord(*to_);
    to_->tableEnd();
    to_->sectionEnd();
  }

  void write_blocks() {
    to_->sectionBlocks();
    for (const char* name : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
      dxf_.writeBlock(*to_, DL_BlockData(name, 0, 0.0, 0.0, 0.0));
      dxf_.writeEndBlock(*to_, name);
    }
    to_->sectionEnd();
  }

  void write_layer(const LineLayer& layer) {
    const DL_Attributes look(capitals(layer.name), kByLayer, -1, "BYLAYER", 1.0);
    for (const DrawnPath& path : layer.paths) write_path(path, look);
    for (const DrawnCircle& circle : layer.circles) {
      const Eigen::Vector2d at = on_page(circle.centre_mm);
      dxf_.writeCircle(
          *to_, DL_CircleData(at.x(), at.y(), 0, in_unit(circle.radius_mm, drawing_.unit)), look);
    }
    constexpr int kLeft = 0, kBaseLine = 0;
    for (const DrawnText& text : layer.texts) {
      const Eigen::Vector2d at = on_page(text.at_mm);
      dxf_.writeText(
          *to_,
          DL_TextData(at.x(), at.y(), 0, at.x(), at.y(), 0, in_unit(text.height_mm, drawing_.unit),
                      1, 0, kLeft, kBaseLine, dxf_text(text.words), kStyle, 0),
          look);
    }
  }

  void write_path(const DrawnPath& path, const DL_Attributes& look) {
    std::vector<Eigen::Vector2d> points = path.points_mm;
    for (Eigen::Vector2d& point : points) point = on_page(point);
    if (points.size() == 2 && !path.closed) {
      dxf_.writeLine(*to_,
                     DL_LineData(points[0].x(), points[0].y(), 0, points[1].x(), points[1].y(), 0),
                     look);
      return;
    }
    dxf_.writePolyline(
        *to_, DL_PolylineData(static_cast<int>(points.size()), 0, 0, path.closed ? 1 : 0), look);
    for (const Eigen::Vector2d& point : points) {
      dxf_.writeVertex(*to_, DL_VertexData(point.x(), point.y(), 0, 0));
    }
    dxf_.writePolylineEnd(*to_);
  }

  const LineDrawing& drawing_;
  // Static storage is zero at first: dxflib writes a handle that it never sets.
  static inline DL_Dxf dxf_;
  const std::unique_ptr<DL_WriterA> to_;
};

}  // namespace

std::string dxf_of(const LineDrawing& drawing) {
  // dxflib writes to a path, but files must appear whole or not at all.
  const MemoryFile file("the DXF file");
  DxfPen(drawing, file.path()).write();
  const std::string text = file.bytes();
  // dxflib does not report that memory ran out.
  if (!text.ends_with("EOF\n")) refuse("it was not written to its end");
  return text;
}

}  // namespace misalign::schema
