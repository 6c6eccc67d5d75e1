// A cursor over a TOML document that knows where it is: file, line and full key ("luminaire[0].flux_lm").
//
// The accessors check type and range and throw std::runtime_error("FILE:LINE: key: expected ..., got ...;
// mend"). A table is first asked to hold known keys only, so that a misspelt one is reported and never passed
// over.
//
// Cursors point into the document and must not outlive it.
#ifndef LUXFIT_APPS_TEXT_TOML_READER_H_
#define LUXFIT_APPS_TEXT_TOML_READER_H_

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

  // `message` is "expected ..., got ...; mend".
  std::runtime_error Error(const std::string& message) const { return InputError(place_, key_, message); }

  // The value as the file has it, for messages.
  std::string Shown() const;

  // Tables. Members and elements come in the order of the file.
  struct Member;
  void ExpectKeys(const std::vector<std::string>& known) const;  // also: expects a table
  std::optional<TomlCursor> Find(const std::string& key) const;
  TomlCursor Require(const std::string& key, const std::string& expected) const;
  std::vector<Member> Members() const;
  std::vector<TomlCursor> Elements(const std::string& expected) const;

  // Values. `expected` completes "expected ..." where the type is wrong.
  bool IsText() const { return node_->is_string(); }
  bool IsArray() const { return node_->is_array(); }
  std::string Text(const std::string& expected) const;  // not empty, one line
  std::string OneOf(const std::vector<std::string>& names) const;
  double Number(const std::string& expected) const;                   // finite; an integer will do
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

// The key `id` of every table of a list; throws where it is missing or two share one.
std::vector<std::string> UniqueIds(const std::vector<TomlCursor>& tables);

// The document of a file. Throws as above where it cannot be read or is not TOML.
toml::table ReadTomlFile(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_TOML_READER_H_
