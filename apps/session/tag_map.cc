#include "apps/session/tag_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/text/formats/text_file.h"
#include "apps/text/input_error.h"
#include "apps/text/suggest.h"

namespace luxfit {
namespace {

using Json = nlohmann::json;

// The tolerances admit rounded figures of a survey (0.71 for sqrt(1/2)). They refuse a vector in other units
// or a wrong axis.
constexpr double kUnitTolerance = 0.02;
constexpr double kPerpendicularTolerance = 0.02;

int LineOf(const std::string& text, size_t byte) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + std::min(byte, text.size()), '\n'));
}

// Finds where each element of the outermost list begins, because the parser keeps no lines.
std::vector<int> ElementLines(const std::string& text) {
  std::vector<int> lines;
  int depth = 0, line = 1;
  bool in_string = false, awaiting = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (awaiting && depth == 1 && !blank && c != ']') {
      lines.push_back(line);
      awaiting = false;
    }
    if (c == '"') in_string = true;
    if (c == '[' || c == '{') awaiting = ++depth == 1;
    if (c == ']' || c == '}') --depth;
    if (c == ',' && depth == 1) awaiting = true;
  }
  return lines;
}

// Holds one entry of the list with the place that its errors name.
struct TagEntry {
  const Json& json;
  SourcePlace place;
  std::string key;  // "tag[3]"

  std::runtime_error Error(const std::string& name, const std::string& message) const {
    return InputError(place, key + (name.empty() ? "" : "." + name), message);
  }
};

const Json& Member(const TagEntry& entry, const std::string& name, const std::string& expected) {
  const auto at = entry.json.find(name);
  if (at != entry.json.end()) return *at;
  std::vector<std::string> present;
  for (const auto& item : entry.json.items()) present.push_back(item.key());
  const std::optional<std::string> nearest = NearestName(name, present);
  throw entry.Error(name, "expected " + expected + ", got nothing; " +
                              (nearest ? "rename " + Quoted(*nearest) + " to " + Quoted(name)
                                       : "add " + Quoted(name) + " to the entry"));
}

double NumberMember(const TagEntry& entry, const std::string& name, const std::string& expected) {
  const Json& value = Member(entry, name, expected);
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw entry.Error(name, "expected " + expected + ", got " + value.dump() + "; write a number");
  return value.get<double>();
}

Eigen::Vector3d VectorMember(const TagEntry& entry, const std::string& name, const std::string& expected) {
  const Json& value = Member(entry, name, expected);
  const auto is_number = [](const Json& item) {
    return item.is_number() && std::isfinite(item.get<double>());
  };
  if (!value.is_array() || value.size() != 3 || !std::all_of(value.begin(), value.end(), is_number))
    throw entry.Error(name,
                      "expected " + expected + ", got " + value.dump() + "; write three numbers [x, y, z]");
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

std::string Rounded(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

Eigen::Vector3d UnitMember(const TagEntry& entry, const std::string& name) {
  const Eigen::Vector3d vector = VectorMember(entry, name, "a unit vector [x, y, z]");
  if (std::abs(vector.norm() - 1) > kUnitTolerance)
    throw entry.Error(name, "expected a unit vector, got one of length " + Rounded(vector.norm()) +
                                "; divide it by its length");
  return vector.normalized();
}

SurveyedTag ReadEntry(const TagEntry& entry) {
  if (!entry.json.is_object())
    throw entry.Error("", "expected {\"id\", \"size_m\", \"center_m\", \"normal\", \"up\"}, got " +
                              entry.json.dump() + "; write one object per tag");
  SurveyedTag tag;
  const Json& id = Member(entry, "id", "a whole number");
  if (!id.is_number_integer() || id.get<int64_t>() < 0 || id.get<int64_t>() > 1'000'000)
    throw entry.Error("id",
                      "expected a whole number >= 0, got " + id.dump() + "; write the number of the tag");
  tag.id = id.get<int>();
  tag.size_m =
      NumberMember(entry, "size_m",
                   "the side of the tag's square in metres (black; of tagStandard41h12 the white one in it)");
  if (tag.size_m <= 0)
    throw entry.Error("size_m", "expected > 0, got " + Rounded(tag.size_m) +
                                    "; write the side of the tag's square in metres");
  tag.center_in_world = VectorMember(entry, "center_m", "the tag's centre in metres [x, y, z]");
  tag.normal_in_world = UnitMember(entry, "normal");
  const Eigen::Vector3d up = UnitMember(entry, "up");
  const double along_normal = up.dot(tag.normal_in_world);
  if (std::abs(along_normal) > kPerpendicularTolerance)
    throw entry.Error("up", "expected a vector perpendicular to normal, got one at " +
                                Rounded(std::acos(std::clamp(along_normal, -1.0, 1.0)) * 180 / M_PI) +
                                " degrees to it; both are given in the scene frame");
  tag.up_in_world = (up - along_normal * tag.normal_in_world).normalized();
  return tag;
}

// Returns the line of a byte without the blanks at its ends, cut to 60 bytes of whole characters. The parser's own words
// cut characters apart.
std::string LineAround(const std::string& text, size_t at) {
  const size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  size_t first = before == std::string::npos ? 0 : before + 1;
  const size_t end = std::min(text.find('\n', first), text.size());
  while (first < end && (text[first] == ' ' || text[first] == '\t')) ++first;
  size_t last = std::min(end, first + 60);
  const auto continues = [&](size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80;
  };
  while (last > first && continues(last)) --last;
  return text.substr(first, last - first);
}

Json ParseText(const std::string& path, const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const size_t at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    throw InputError({path, LineOf(text, at)}, "",
                     "expected valid JSON, got " + Quoted(LineAround(text, at)) +
                         "; fix the line, or the comma or bracket before it");
  } catch (const Json::out_of_range&) {
    throw InputError({path, 0}, "", "expected numbers of up to 1e308, got a larger one; correct it");
  }
}

}  // namespace

std::vector<SurveyedTag> ReadTagMap(const std::string& path) {
  const std::string text = ReadTextFile(path, "a tag map");
  const Json root = ParseText(path, text);
  if (!root.is_array() || root.empty())
    throw InputError({path, 1}, "",
                     std::string("expected a list of at least one tag, got ") +
                         (root.is_array() ? "an empty one" : root.type_name()) +
                         "; write [{\"id\", \"size_m\", \"center_m\", \"normal\", \"up\"}, ...]");
  const std::vector<int> lines = ElementLines(text);
  std::vector<SurveyedTag> survey;
  std::map<int, size_t> entry_of_id;
  for (size_t i = 0; i < root.size(); ++i) {
    const TagEntry entry{root[i], {path, i < lines.size() ? lines[i] : 0}, "tag[" + std::to_string(i) + "]"};
    survey.push_back(ReadEntry(entry));
    const auto [first, is_new] = entry_of_id.emplace(survey.back().id, i);
    if (!is_new)
      throw entry.Error("id", "expected every id once, got " + std::to_string(survey.back().id) + " in tag[" +
                                  std::to_string(first->second) + "] (line " +
                                  std::to_string(lines[first->second]) + ") and tag[" + std::to_string(i) +
                                  "] (line " + std::to_string(lines[i]) + "); correct or remove one of them");
  }
  return survey;
}

}  // namespace luxfit
