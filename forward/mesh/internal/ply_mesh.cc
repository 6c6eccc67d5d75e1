#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "forward/mesh/internal/polygon_mesh.h"

namespace luxfit {
namespace {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;
};

struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties;
};

size_t SizeOf(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat:
      return 4;
    case PlyType::kDouble:
      return 8;
  }
  return 0;
}

template <typename T>
double ValueOf(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

// Returns the value of bytes in this machine's order.
double ValueOf(PlyType type, const char* bytes) {
  switch (type) {
    case PlyType::kInt8:
      return ValueOf<int8_t>(bytes);
    case PlyType::kUint8:
      return ValueOf<uint8_t>(bytes);
    case PlyType::kInt16:
      return ValueOf<int16_t>(bytes);
    case PlyType::kUint16:
      return ValueOf<uint16_t>(bytes);
    case PlyType::kInt32:
      return ValueOf<int32_t>(bytes);
    case PlyType::kUint32:
      return ValueOf<uint32_t>(bytes);
    case PlyType::kFloat:
      return ValueOf<float>(bytes);
    case PlyType::kDouble:
      return ValueOf<double>(bytes);
  }
  return 0;
}

bool IsSpace(char c) { return c == '\n' || IsMeshBlank(c); }

class PlyParser {
 public:
  PlyParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  PolygonMesh Parse() {
    ParseHeader();
    mesh_.materials = {kDefaultMaterial};
    for (const PlyElement& element : elements_) {
      ExpectRoomFor(element);
      if (element.name == "vertex") {
        ReadVertices(element);
      } else if (element.name == "face") {
        ReadFaces(element);
      } else {
        for (long long i = 0; i < element.count; ++i) Skip(element, i);
      }
    }
    for (size_t c = 0; c < mesh_.corners.size(); ++c) ExpectVertex(mesh_.corners[c]);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void Fail(const std::string& message) const {
    const std::string line = format_ == PlyFormat::kAscii ? ":" + std::to_string(line_) : "";
    throw std::runtime_error(name_ + line + ": " + message);
  }

  PlyType TypeOf(std::string_view word) const {
    static constexpr std::string_view kNames[][2] = {
        {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
        {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
    for (int t = 0; t < 8; ++t) {
      if (word == kNames[t][0] || word == kNames[t][1]) return static_cast<PlyType>(t);
    }
    Fail("property: expected a type such as float, got \"" + std::string(word.substr(0, 40)) +
         "\"; export again");
  }

  void ParseHeader() {
    bool has_format = false;
    PlyFormat format = PlyFormat::kAscii;
    for (line_ = 1; !bytes_.empty(); ++line_) {
      const size_t end = std::min(bytes_.find('\n'), bytes_.size());
      std::string_view line = bytes_.substr(0, end);
      bytes_.remove_prefix(std::min(end + 1, bytes_.size()));
      const std::string_view keyword = NextWord(line);
      if (line_ == 1 && keyword != "ply") Fail("expected a PLY file, got another first line than \"ply\"");
      if (keyword == "end_header") {
        if (!has_format) Fail("expected a format line in the header, got none");
        format_ = format;
        ++line_;
        return;
      }
      if (keyword == "format") {
        const std::string_view word = NextWord(line);
        has_format = true;
        format = word == "binary_little_endian" ? PlyFormat::kLittleEndian
                 : word == "binary_big_endian"  ? PlyFormat::kBigEndian
                                                : PlyFormat::kAscii;
        if (format == PlyFormat::kAscii && word != "ascii")
          Fail("format: expected ascii, binary_little_endian or binary_big_endian; export again");
      } else if (keyword == "element") {
        AddElement(line);
      } else if (keyword == "property") {
        AddProperty(line);
      }
    }
    Fail("expected end_header, got the file's end; it is truncated");
  }

  void AddElement(std::string_view line) {
    PlyElement element;
    element.name = std::string(NextWord(line));
    const std::string_view count = NextWord(line);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || end != count.data() + count.size() || element.count < 0 ||
        element.count > 2147483647LL)
      Fail("element: expected a name and a count, got \"" + std::string(count.substr(0, 40)) +
           "\"; export again");
    elements_.push_back(element);
  }

  void AddProperty(std::string_view line) {
    if (elements_.empty()) Fail("property: expected an element before it, got none; export again");
    PlyProperty property;
    std::string_view type = NextWord(line);
    property.is_list = type == "list";
    if (property.is_list) {
      property.count_type = TypeOf(NextWord(line));
      type = NextWord(line);
    }
    property.type = TypeOf(type);
    property.name = std::string(NextWord(line));
    elements_.back().properties.push_back(property);
  }

  // Refuses a count that the file cannot hold before anything is made of its size.
  void ExpectRoomFor(const PlyElement& element) const {
    size_t least = 0;
    for (const PlyProperty& property : element.properties) {
      least +=
          format_ == PlyFormat::kAscii ? 1 : SizeOf(property.is_list ? property.count_type : property.type);
    }
    if (least == 0 && element.count > 0) Fail("element " + element.name + ": expected properties, got none");
    if (least > 0 && static_cast<size_t>(element.count) > bytes_.size() / least + 1)
      Fail("element " + element.name + ": expected " + std::to_string(element.count) + ", got " +
           std::to_string(bytes_.size()) + " bytes, too few for them; the file is truncated");
  }

  double Next(PlyType type, const PlyElement& element, long long index) {
    if (format_ == PlyFormat::kAscii) return NextText(element, index);
    const size_t size = SizeOf(type);
    if (bytes_.size() < size) FailTruncated(element, index);
    char bytes[8];
    std::copy_n(bytes_.data(), size, bytes);
    bytes_.remove_prefix(size);
    const uint16_t one = 1;
    const bool little = ValueOf<uint8_t>(reinterpret_cast<const char*>(&one)) == 1;
    if (little != (format_ == PlyFormat::kLittleEndian)) std::reverse(bytes, bytes + size);
    return ValueOf(type, bytes);
  }

  double NextText(const PlyElement& element, long long index) {
    while (!bytes_.empty() && IsSpace(bytes_.front())) {
      line_ += bytes_.front() == '\n' ? 1 : 0;
      bytes_.remove_prefix(1);
    }
    if (bytes_.empty()) FailTruncated(element, index);
    if (bytes_.front() == '+') bytes_.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(bytes_.data(), bytes_.data() + bytes_.size(), value);
    const size_t length = static_cast<size_t>(end - bytes_.data());
    if (error != std::errc() || (length < bytes_.size() && !IsSpace(bytes_[length])))
      Fail("element " + element.name + " " + std::to_string(index) +
           ": expected a number; export the mesh again");
    bytes_.remove_prefix(length);
    return value;
  }

  [[noreturn]] void FailTruncated(const PlyElement& element, long long index) const {
    Fail("element " + element.name + ": expected " + std::to_string(element.count) + ", got " +
         std::to_string(index) + "; the file is truncated");
  }

  size_t NextCount(const PlyProperty& property, const PlyElement& element, long long index) {
    const double count = Next(property.count_type, element, index);
    if (!(count >= 0 && count <= kMaxPolygonCorners) || count != std::floor(count))
      Fail("element " + element.name + " " + std::to_string(index) + ": expected a list of 0 to " +
           std::to_string(kMaxPolygonCorners) + " entries, got " + std::to_string(count) +
           "; triangulate the mesh");
    return static_cast<size_t>(count);
  }

  void Skip(const PlyElement& element, long long index) {
    for (const PlyProperty& property : element.properties) SkipProperty(property, element, index);
  }

  void SkipProperty(const PlyProperty& property, const PlyElement& element, long long index) {
    const size_t count = property.is_list ? NextCount(property, element, index) : 1;
    for (size_t i = 0; i < count; ++i) Next(property.type, element, index);
  }

  void ReadVertices(const PlyElement& element) {
    for (const char* axis : {"x", "y", "z"}) {
      const auto has = [&](const PlyProperty& p) { return p.name == axis && !p.is_list; };
      if (std::none_of(element.properties.begin(), element.properties.end(), has))
        Fail(std::string("element vertex: expected a property ") + axis +
             ", got none; export the mesh again");
    }
    for (long long i = 0; i < element.count; ++i) {
      Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
      for (const PlyProperty& property : element.properties) {
        const bool is_axis = property.name.size() == 1 && property.name[0] >= 'x' &&
                             property.name[0] <= 'z' && !property.is_list;
        if (is_axis) {
          vertex[property.name[0] - 'x'] = Next(property.type, element, i);
        } else {
          SkipProperty(property, element, i);
        }
      }
      if (!vertex.allFinite())
        Fail("element vertex " + std::to_string(i) + ": expected finite coordinates; export again");
      mesh_.vertices.push_back(vertex);
    }
  }

  void ReadFaces(const PlyElement& element) {
    for (long long i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (!property.is_list || (property.name != "vertex_indices" && property.name != "vertex_index")) {
          SkipProperty(property, element, i);
          continue;
        }
        mesh_.first_corner.push_back(mesh_.corners.size());
        mesh_.material.push_back(0);
        const size_t count = NextCount(property, element, i);
        for (size_t c = 0; c < count; ++c) {
          const double index = Next(property.type, element, i);
          if (!(index >= 0 && index <= 2147483647.0) || index != std::floor(index))
            Fail("element face " + std::to_string(i) + ": expected the index of a vertex, got " +
                 std::to_string(index) + "; export the mesh again");
          mesh_.corners.push_back(static_cast<int>(index));
        }
      }
    }
  }

  void ExpectVertex(int index) const {
    if (static_cast<size_t>(index) >= mesh_.vertices.size())
      throw std::runtime_error(name_ + ": element face: expected one of " +
                               std::to_string(mesh_.vertices.size()) + " vertices, got index " +
                               std::to_string(index) + "; export the mesh again");
  }

  std::string_view bytes_;
  const std::string& name_;
  PlyFormat format_ = PlyFormat::kAscii;  // text until the header has ended
  int line_ = 1;
  std::vector<PlyElement> elements_;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh ParsePly(std::string_view bytes, const std::string& name) {
  return PlyParser(bytes, name).Parse();
}

}  // namespace luxfit
