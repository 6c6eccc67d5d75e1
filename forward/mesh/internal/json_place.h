// Pairs a value within a JSON document with its JSON pointer, so that an error can name it.
//
// The document must outlive it. Throws std::runtime_error("FILE: /accessors/3/count: expected ..., got ...;
// export it again") where a value is missing or of another type. Source: RFC 6901 (JSON pointer).
#ifndef LUXFIT_FORWARD_MESH_INTERNAL_JSON_PLACE_H_
#define LUXFIT_FORWARD_MESH_INTERNAL_JSON_PLACE_H_

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace luxfit {

class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string file, std::string pointer = "")
      : value_(&value), file_(std::move(file)), pointer_(std::move(pointer)) {}

  [[noreturn]] void Fail(const std::string& message) const {
    throw std::runtime_error(file_ + ": " + (pointer_.empty() ? "" : pointer_ + ": ") + message);
  }
  // Throws for a value that is not what it should be.
  [[noreturn]] void FailExpecting(const std::string& expected) const {
    // The text of lists is left out: they may be nested deeper than the stack.
    const std::string got = value_->is_structured() ? value_->type_name() : value_->dump().substr(0, 40);
    Fail("expected " + expected + ", got " + got + "; export it again");
  }

  bool Has(const char* key) const { return value_->is_object() && value_->contains(key); }

  JsonPlace At(const char* key) const {
    if (!value_->is_object()) FailExpecting("an object");
    const auto found = value_->find(key);
    if (found == value_->end()) Fail(std::string("expected a key \"") + key + "\", got none");
    return {*found, file_, pointer_ + "/" + key};
  }

  JsonPlace At(size_t index) const {
    if (index >= Count()) Fail("expected more than " + std::to_string(index) + " values");
    return {(*value_)[index], file_, pointer_ + "/" + std::to_string(index)};
  }

  size_t Count() const {
    if (!value_->is_array()) FailExpecting("a list");
    return value_->size();
  }

  // Returns a whole number up to 2^53: sums of two of them do not overflow.
  size_t Integer() const {
    if (!value_->is_number_unsigned() || value_->get<uint64_t>() > uint64_t{1} << 53)
      FailExpecting("a whole number from 0 to 2^53");
    return value_->get<size_t>();
  }
  size_t IntegerOr(const char* key, size_t absent) const { return Has(key) ? At(key).Integer() : absent; }

  double Number() const {
    if (!value_->is_number()) FailExpecting("a number");
    return value_->get<double>();
  }

  const std::string& Text() const {
    if (!value_->is_string()) FailExpecting("a text");
    return value_->get_ref<const std::string&>();
  }

 private:
  const nlohmann::json* value_;
  std::string file_, pointer_;
};

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_MESH_INTERNAL_JSON_PLACE_H_
