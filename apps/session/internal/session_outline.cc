#include "apps/session/internal/session_outline.h"

#include <cmath>
#include <string>
#include <vector>

namespace luxfit {
namespace {

constexpr double kTurnRadPerDeg = 3.14159265358979323846 / 180;

// Checks that the section says once what the room is.
void ExpectOneRoom(const TomlCursor& section) {
  std::vector<std::string> given;
  for (const char* key : {"mesh", "size", "outline"}) {
    if (section.Find(key)) given.emplace_back(key);
  }
  if (given.empty())
    throw InputError(section.place(), section.key() + ".mesh",
                     "expected what the room is: mesh, size or outline, got none; add size = [6, 4, 2.8] "
                     "(length along x, along y, height), or mesh = \"room.obj\"");
  if (given.size() > 1)
    throw section.Find(given[1])->Error("expected one of mesh, size and outline, got " + given[0] + " and " +
                                        given[1] + "; remove all but one");
  const bool is_outline = given[0] == "outline";
  if (const auto height = section.Find("height"); height && !is_outline)
    throw height->Error("expected no height beside " + given[0] + ", got one; remove it, or give an outline");
  for (const char* key : {"box", "opening"}) {
    const auto list = section.Find(key);
    if (list && given[0] == "mesh")
      throw list->Error("expected none beside a mesh, got " + std::string(key) +
                        "; draw it in the mesh, or give size or outline in place of mesh");
  }
}

RoomOutline ReadSize(const TomlCursor& size, double metres_per_unit) {
  const Eigen::Vector3d lengths = size.Vector("the room's three lengths [along x, along y, height]");
  if (!(lengths.minCoeff() > 0))
    throw size.Error("expected three lengths > 0, got " + size.Shown() +
                     "; write [length along x, along y, height]");
  return OutlineOfBox(metres_per_unit * lengths);
}

RoomOutline ReadCorners(const TomlCursor& section, double metres_per_unit) {
  RoomOutline outline;
  for (const TomlCursor& corner :
       section.Find("outline")->Elements("the corners of the floor, [[x, y], ...]")) {
    const std::vector<double> place = corner.Numbers("a corner [x, y]");
    if (place.size() != 2)
      throw corner.Error("expected a corner [x, y], got " + corner.Shown() + "; write two numbers");
    outline.corners_m.emplace_back(metres_per_unit * place[0], metres_per_unit * place[1]);
  }
  const TomlCursor height =
      section.Require("height", "the height of the ceiling (a number, or one for each corner)");
  if (height.IsArray()) {
    outline.heights_m = height.Numbers("the height of the ceiling (a number, or one for each corner)");
  } else {
    outline.heights_m = {height.Number("the height of the ceiling (a number, or one for each corner)")};
  }
  for (double& metres : outline.heights_m) metres *= metres_per_unit;
  return outline;
}

RoomBox ReadBox(const TomlCursor& table, double metres_per_unit) {
  table.ExpectKeys({"name", "min", "max", "turn_deg"});
  RoomBox box;
  box.name = table.Require("name", "a name, which is also the material's").Text("a name");
  box.min_m =
      metres_per_unit * table.Require("min", "the lowest corner [x, y, z]").Vector("a corner [x, y, z]");
  box.max_m =
      metres_per_unit * table.Require("max", "the highest corner [x, y, z]").Vector("a corner [x, y, z]");
  if (const auto turn = table.Find("turn_deg"))
    box.turn_rad = kTurnRadPerDeg * turn->Number("an angle (degrees)");
  return box;
}

WallRectangle ReadOpening(const TomlCursor& table, double metres_per_unit) {
  table.ExpectKeys({"name", "wall", "from", "to", "low", "high"});
  const auto length = [&](const std::string& key, const std::string& what) {
    return metres_per_unit * table.Require(key, what).Number("a length");
  };
  WallRectangle rectangle;
  rectangle.name = table.Require("name", "a name, which is also the material's").Text("a name");
  rectangle.wall =
      table.Require("wall", "the number of its wall").WholeNumber("the number of its wall, from 1 on") - 1;
  rectangle.from_m = length("from", "where it begins along the wall");
  rectangle.to_m = length("to", "where it ends along the wall");
  rectangle.high_m = length("high", "the height of its upper edge");
  if (table.Find("low")) rectangle.low_m = length("low", "the height of its lower edge");
  return rectangle;
}

void ExpectPossible(const TomlCursor& section, const RoomOutline& outline) {
  const auto fault = FindFault(outline);
  if (!fault) return;
  const auto element = [&](const char* list) {
    return section.Find(list)->Elements("a list").at(static_cast<size_t>(fault->index));
  };
  const auto size = section.Find("size");
  switch (fault->part) {
    case OutlinePart::kCorners:
      throw(size ? *size : *section.Find("outline")).Error(fault->message);
    case OutlinePart::kHeights:
      throw(size ? *size : *section.Find("height")).Error(fault->message);
    case OutlinePart::kBox:
      throw element("box").Error(fault->message);
    case OutlinePart::kRectangle:
      throw element("opening").Error(fault->message);
  }
}

}  // namespace

std::optional<RoomOutline> ReadOutline(const TomlCursor& section, double metres_per_unit) {
  ExpectOneRoom(section);
  if (section.Find("mesh")) return {};
  const auto size = section.Find("size");
  RoomOutline outline = size ? ReadSize(*size, metres_per_unit) : ReadCorners(section, metres_per_unit);
  if (const auto boxes = section.Find("box")) {
    for (const TomlCursor& table : boxes->Elements("a list of tables [[scene.box]]"))
      outline.boxes.push_back(ReadBox(table, metres_per_unit));
  }
  if (const auto openings = section.Find("opening")) {
    for (const TomlCursor& table : openings->Elements("a list of tables [[scene.opening]]"))
      outline.rectangles.push_back(ReadOpening(table, metres_per_unit));
  }
  ExpectPossible(section, outline);
  return outline;
}

}  // namespace luxfit
