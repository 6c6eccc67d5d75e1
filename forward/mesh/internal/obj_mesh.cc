#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "forward/mesh/internal/polygon_mesh.h"

namespace luxfit {
namespace {

std::string Quote(std::string_view word) {
  std::string text(word.substr(0, 40));
  for (char& c : text) c = c < 32 || c > 126 ? '?' : c;
  return '"' + text + '"';
}

class ObjParser {
 public:
  ObjParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  PolygonMesh Parse() {
    while (!text_.empty()) ParseStatement(NextStatement());
    for (size_t f = 0; f < mesh.first_corner.size(); ++f) {
      for (size_t c = mesh.first_corner[f]; c < mesh.CornersEnd(f); ++c)
        ExpectVertex(mesh.corners[c], line_of_face_[f]);
    }
    return std::move(mesh);
  }

 private:
  [[noreturn]] void Fail(int line, const std::string& message) const {
    throw std::runtime_error(name_ + ":" + std::to_string(line) + ": " + message);
  }

  // Returns one line, joined with those that a backslash at its end continues.
  std::string_view NextStatement() {
    line_ = next_line_;
    joined_.clear();
    while (true) {
      const size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++next_line_;
      while (!line.empty() && IsMeshBlank(line.back())) line.remove_suffix(1);
      const bool goes_on = !line.empty() && line.back() == '\\' && !text_.empty();
      if (!goes_on && joined_.empty()) return line;
      joined_ += goes_on ? line.substr(0, line.size() - 1) : line;
      if (!goes_on) return joined_;
      joined_ += ' ';
    }
  }

  void ParseStatement(std::string_view rest) {
    const std::string_view keyword = NextWord(rest);
    if (keyword == "v") {
      AddVertex(rest);
    } else if (keyword == "f") {
      AddFace(rest);
    } else if (keyword == "usemtl") {
      while (!rest.empty() && IsMeshBlank(rest.front())) rest.remove_prefix(1);
      material_ = mesh.MaterialIndex(std::string(rest.empty() ? kDefaultMaterial : rest));
    }
  }

  void AddVertex(std::string_view rest) {
    Eigen::Vector3d vertex;
    for (int axis = 0; axis < 3; ++axis) {
      std::string_view word = NextWord(rest);
      if (!word.empty() && word.front() == '+') word.remove_prefix(1);
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), vertex[axis]);
      if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(vertex[axis]))
        Fail(line_, "v: expected three finite numbers, got " + (word.empty() ? "fewer" : Quote(word)) +
                        "; export the mesh again, with decimal points");
    }
    mesh.vertices.push_back(vertex);
  }

  void AddFace(std::string_view rest) {
    const size_t first = mesh.corners.size();
    for (std::string_view word = NextWord(rest); !word.empty(); word = NextWord(rest)) {
      if (word.front() == '#') break;
      const size_t length = std::min(word.find('/'), word.size());
      long long index = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + length, index);
      const long long count = static_cast<long long>(mesh.vertices.size());
      if (error != std::errc() || end != word.data() + length || index == 0 || index > 2147483647LL ||
          index < -count)
        Fail(line_, "f: expected the number of a vertex, got " + Quote(word) + " (" + std::to_string(count) +
                        " vertices so far); export the mesh again");
      mesh.corners.push_back(static_cast<int>(index > 0 ? index - 1 : count + index));
    }
    const size_t corners = mesh.corners.size() - first;
    if (corners > static_cast<size_t>(kMaxPolygonCorners))
      Fail(line_, "f: expected at most " + std::to_string(kMaxPolygonCorners) + " corners, got " +
                      std::to_string(corners) + "; triangulate the mesh");
    if (mesh.materials.empty()) material_ = mesh.MaterialIndex(kDefaultMaterial);
    mesh.first_corner.push_back(first);
    mesh.material.push_back(material_);
    line_of_face_.push_back(line_);
  }

  // A face may name vertices that come after it, so this waits for the file's end.
  void ExpectVertex(int index, int line) const {
    if (static_cast<size_t>(index) >= mesh.vertices.size())
      Fail(line, "f: expected one of " + std::to_string(mesh.vertices.size()) + " vertices, got number " +
                     std::to_string(static_cast<long long>(index) + 1) +
                     "; is the file truncated? export it again");
  }

  std::string_view text_;
  const std::string& name_;
  std::string joined_;
  int line_ = 0, next_line_ = 1;
  int material_ = 0;
  std::vector<int> line_of_face_;
  PolygonMesh mesh;
};

}  // namespace

PolygonMesh ParseObj(std::string_view text, const std::string& name) { return ObjParser(text, name).Parse(); }

}  // namespace luxfit
