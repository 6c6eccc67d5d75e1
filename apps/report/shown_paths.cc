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

std::string CommonFolder(const std::vector<std::string>& files) {
  if (files.empty()) return "";
  const auto folder_of = [](const std::string& path) { return path.substr(0, path.find_last_of('/') + 1); };
  std::string common = folder_of(files.front());
  for (const std::string& file : files) {
    while (file.compare(0, common.size(), common) != 0)
      common = folder_of(common.substr(0, common.size() - 1));
  }
  return common.substr(0, common.empty() ? 0 : common.size() - 1);
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
