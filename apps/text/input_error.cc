#include "apps/text/input_error.h"

namespace luxfit {

std::runtime_error InputError(const SourcePlace& place, const std::string& key, const std::string& message) {
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line);
  text += ": ";
  if (!key.empty()) text += key + ": ";
  return std::runtime_error(text + message);
}

}  // namespace luxfit
