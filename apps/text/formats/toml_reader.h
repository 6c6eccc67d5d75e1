// Reads a TOML document through cursors that know their place: file, line and full key
// ("luminaire[0].flux_lm").
//
// The accessors check type and range. They throw std::runtime_error("FILE:LINE: key: expected ..., got ...;
// remedy"). Each table is first checked for known keys alone, so that a misspelt key is reported and never
// ignored.
//
// Cursors point into the document and must not outlive it.
#ifndef LUXFIT_APPS_TEXT_FORMATS_TOML_READER_H_
#define LUXFIT_APPS_TEXT_FORMATS_TOML_READER_H_

#include <toml++/toml.h>
#include <Eigen/Core>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/text/input_error.h"

namespace luxfit {

class TomlCursor {
 public:
  TomlCursor(const toml::node& node, SourcePlace place, std::string key)
      : node_(&node), place_(std::move(place)), key_(std::move(key)) {}

  const std::string& key() const { return key_; }
  const SourcePlace& place() const { return place_; }

  // `message` is "expected ..., got ...; remedy".
  std::runtime_error Error(const std::string& message) const { return InputError(place_, key_, message); }

  // Returns the value as the file has it, for messages.
  std::string Shown() const;

  // Tables. Members and elements come in the order of the file.
  struct Member;
  void ExpectKeys(const std::vector<std::string>& known) const;  // also expects a table
  std::optional<TomlCursor> Find(const std::string& key) const;
  TomlCursor Require(const std::string& key, const std::string& expected) const;
  std::vector<Member> Members() const;
  std::vector<TomlCursor> Elements(const std::string& expected) const;

  // Values. `expected` completes "expected ..." where the type is wrong.
  bool IsText() const { return node_->is_string(); }
  bool IsArray() const { return node_->is_array(); }
  std::string Text(const std::string& expected) const;  // not empty, one line
  std::string OneOf(const std::vector<std::string>& names) const;
  double Number(const std::string& expected) const;                   // finite; an integer is accepted
  double NumberAbove(double limit, const std::string& unit) const;    // > limit
  double NumberAtLeast(double limit, const std::string& unit) const;  // >= limit
  int WholeNumber(const std::string& expected) const;                 // >= 1
  std::vector<double> Numbers(const std::string& expected) const;
  Eigen::Vector3d Vector(const std::string& expected) const;
  Eigen::Vector3d Direction(const std::string& expected) const;  // normalised; zero is an error

 private:
  const toml::node* node_;
  SourcePlace place_;
  std::string key_;
};

struct TomlCursor::Member {
  std::string name;
  TomlCursor value;
};

// Returns the key `id` of every table of a list. Throws where it is missing or two tables share one.
std::vector<std::string> UniqueIds(const std::vector<TomlCursor>& tables);

// Reads the document of a file. Throws as above where it cannot be read or is not TOML.
toml::table ReadTomlFile(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_FORMATS_TOML_READER_H_
