#include "apps/text/formats/toml_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include "apps/text/formats/text_file.h"
#include "apps/text/suggest.h"
#include "forward/room/one_line.h"

namespace luxfit {
namespace {

constexpr char kControlCharacter[] =
    "expected a name of one line without control characters, got one with a line break or the like; remove "
    "it";

std::string ShownNumber(double number) {
  std::ostringstream text;
  text.precision(10);
  text << number;
  return text.str();
}

}  // namespace

std::string TomlCursor::Shown() const {
  if (node_->is_table()) return "a table";
  if (const toml::value<std::string>* value = node_->as_string()) return Quoted(value->get());
  std::ostringstream text;
  node_->visit([&](const auto& value) { text << value; });
  return text.str();
}

void TomlCursor::ExpectKeys(const std::vector<std::string>& known) const {
  for (const Member& member : Members()) {
    if (std::find(known.begin(), known.end(), member.name) != known.end()) continue;
    const std::string nearest = DidYouMean(member.name, known);
    throw member.value.Error("expected a known key (" + ListNames(known) + "), got " + Quoted(member.name) +
                             (nearest.empty() ? "; remove it or correct its spelling" : nearest));
  }
}

std::optional<TomlCursor> TomlCursor::Find(const std::string& key) const {
  for (Member& member : Members())
    if (member.name == key) return std::move(member.value);
  return std::nullopt;
}

TomlCursor TomlCursor::Require(const std::string& key, const std::string& expected) const {
  if (std::optional<TomlCursor> value = Find(key)) return *value;
  throw InputError(place_, key_.empty() ? key : key_ + "." + key,
                   "expected " + expected + ", got nothing; add " + key + " = ...");
}

std::vector<TomlCursor::Member> TomlCursor::Members() const {
  const toml::table* table = node_->as_table();
  if (!table) throw Error("expected a table, got " + Shown() + "; write [" + key_ + "] or { ... }");
  std::vector<std::pair<toml::source_position, Member>> placed;
  for (const auto& [name, node] : *table) {
    const std::string member_key = (key_.empty() ? "" : key_ + ".") + std::string(name.str());
    const toml::source_position position = name.source().begin;
    const SourcePlace place{place_.file, static_cast<int>(position.line)};
    if (HasControlCharacter(std::string(name.str())))
      throw InputError(place, OneLine(member_key), kControlCharacter);
    placed.push_back({position, {std::string(name.str()), TomlCursor(node, place, member_key)}});
  }
  // The parser sorts keys by name; the file has them in the user's order.
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& left, const auto& right) { return left.first < right.first; });
  std::vector<Member> members;
  members.reserve(placed.size());
  for (auto& [position, member] : placed) members.push_back(std::move(member));
  return members;
}

std::vector<TomlCursor> TomlCursor::Elements(const std::string& expected) const {
  const toml::array* array = node_->as_array();
  if (!array) throw Error("expected " + expected + ", got " + Shown() + "; write a list");
  std::vector<TomlCursor> elements;
  for (const toml::node& node : *array) {
    const int line = static_cast<int>(node.source().begin.line);
    const std::string key = key_ + "[" + std::to_string(elements.size()) + "]";
    elements.emplace_back(node, SourcePlace{place_.file, line > 0 ? line : place_.line}, key);
  }
  return elements;
}

std::string TomlCursor::Text(const std::string& expected) const {
  const toml::value<std::string>* text = node_->as_string();
  if (!text) throw Error("expected " + expected + ", got " + Shown() + "; write it between double quotes");
  if (text->get().empty()) throw Error("expected " + expected + ", got \"\"; fill it in or remove the key");
  if (HasControlCharacter(text->get())) throw Error(kControlCharacter);
  return text->get();
}

std::string TomlCursor::OneOf(const std::vector<std::string>& names) const {
  std::string text = Text(ListNames(names));
  if (std::find(names.begin(), names.end(), text) == names.end()) throw Error(ExpectedOneOf(names, text));
  return text;
}

double TomlCursor::Number(const std::string& expected) const {
  const std::optional<double> number = node_->is_number() ? node_->value<double>() : std::nullopt;
  if (!number || !std::isfinite(*number))
    throw Error("expected " + expected + ", got " + Shown() +
                "; write a finite number such as 1.5, without quotes");
  return *number;
}

double TomlCursor::NumberAbove(double limit, const std::string& unit) const {
  const double number = Number("a number (" + unit + ")");
  if (number > limit) return number;
  throw Error("expected > " + ShownNumber(limit) + ", got " + Shown() + "; write it in " + unit);
}

double TomlCursor::NumberAtLeast(double limit, const std::string& unit) const {
  const double number = Number("a number (" + unit + ")");
  if (number >= limit) return number;
  throw Error("expected >= " + ShownNumber(limit) + ", got " + Shown() + "; write it in " + unit);
}

int TomlCursor::WholeNumber(const std::string& expected) const {
  const std::optional<int64_t> number = node_->is_integer() ? node_->value<int64_t>() : std::nullopt;
  if (!number || *number < 1 || *number > 1'000'000)
    throw Error("expected " + expected + ", got " + Shown() + "; write a whole number >= 1");
  return static_cast<int>(*number);
}

std::vector<double> TomlCursor::Numbers(const std::string& expected) const {
  std::vector<double> numbers;
  for (const TomlCursor& element : Elements(expected)) numbers.push_back(element.Number("a number"));
  return numbers;
}

Eigen::Vector3d TomlCursor::Vector(const std::string& expected) const {
  const std::vector<double> numbers = Numbers(expected);
  if (numbers.size() != 3) throw Error("expected " + expected + ", got " + Shown() + "; write three numbers");
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Vector3d TomlCursor::Direction(const std::string& expected) const {
  const Eigen::Vector3d vector = Vector(expected);
  if (vector.norm() < 1e-9)
    throw Error("expected " + expected + ", got " + Shown() + "; write a vector that is not zero");
  return vector.normalized();
}

std::vector<std::string> UniqueIds(const std::vector<TomlCursor>& tables) {
  std::vector<std::string> ids;
  std::vector<int> lines;
  for (const TomlCursor& table : tables) {
    const TomlCursor id = table.Require("id", "a name");
    const auto same = std::find(ids.begin(), ids.end(), id.Text("a name"));
    if (same != ids.end())
      throw id.Error("expected a name of its own, got " + id.Shown() + ", which line " +
                     std::to_string(lines[same - ids.begin()]) + " has already; rename one of them");
    ids.push_back(id.Text("a name"));
    lines.push_back(id.place().line);
  }
  return ids;
}

toml::table ReadTomlFile(const std::string& path) {
  const std::string text = ReadTextFile(path, "a file");
  try {
    return toml::parse(std::string_view(text), std::string_view(path));
  } catch (const toml::parse_error& error) {
    throw InputError({path, static_cast<int>(error.source().begin.line)}, "",
                     "expected valid TOML, got an error: " + std::string(error.description()) +
                         "; fix this line or the one before it");
  }
}

}  // namespace luxfit
