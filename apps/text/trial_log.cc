#include "apps/text/trial_log.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace luxfit {

TrialLog::TrialLog(std::string path, std::string key) : path_(std::move(path)), key_(std::move(key)) {
  std::ifstream file(path_);
  for (std::string line; std::getline(file, line);) {
    nlohmann::json kept = nlohmann::json::parse(line, nullptr, false);
    if (!kept.is_object() || kept.value("key", "") != key_ || !kept.contains("trial")) continue;
    const std::string trial = kept["trial"];
    lines_[trial] = std::move(kept);
  }
}

const nlohmann::json* TrialLog::Find(const std::string& trial) const {
  const auto found = lines_.find(trial);
  return found == lines_.end() ? nullptr : &found->second;
}

void TrialLog::Append(const std::string& trial, nlohmann::json result) {
  result["key"] = key_;
  result["trial"] = trial;
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), error);
  // A line break closes an incomplete line that a program left when it died.
  std::fstream tail(path_, std::ios::in | std::ios::binary | std::ios::ate);
  bool is_cut = false;
  if (tail && tail.tellg() > 0) {
    tail.seekg(-1, std::ios::end);
    is_cut = tail.get() != '\n';
  }
  std::ofstream file(path_, std::ios::app | std::ios::binary);
  file << (is_cut ? "\n" : "") + result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
       << std::flush;
  if (!file)
    throw std::runtime_error(path_ + ": expected a writable place; check the folder and the free space");
  lines_[trial] = std::move(result);
}

}  // namespace luxfit
