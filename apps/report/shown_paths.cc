#include "apps/report/shown_paths.h"

#include <nlohmann/json.hpp>
#include <regex>

namespace luxfit {

using nlohmann::json;

std::string WithoutFolders(const std::string& text, const std::vector<std::string>& folders) {
  if (text.find('/') == std::string::npos) return text;
  std::string shown = text;
  for (const std::string& folder : folders) {
    if (folder.empty()) continue;
    for (size_t at = 0; (at = shown.find(folder + "/", at)) != std::string::npos;)
      shown.erase(at, folder.size() + 1);
  }
  static const std::regex within("(^|[\\s\"'=(,:])/(?:[^\\s\"'/]+/)+([^\\s\"'/]+)");
  return std::regex_replace(shown, within, "$1$2");
}

json JsonWithoutFolders(const json& data, const std::vector<std::string>& folders) {
  if (data.is_string()) return WithoutFolders(data.get<std::string>(), folders);
  if (!data.is_structured()) return data;
  json shown = data.is_array() ? json::array() : json::object();
  if (data.is_array()) {
    for (const json& element : data) shown.push_back(JsonWithoutFolders(element, folders));
    return shown;
  }
  for (const auto& [key, value] : data.items())
    shown[WithoutFolders(key, folders)] = JsonWithoutFolders(value, folders);
  return shown;
}

}  // namespace luxfit
