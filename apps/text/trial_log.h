// Appends lines of JSON as the trials of a long sweep end, so that a second call continues where the first
// stopped.
//
// Every line holds `key`, which identifies what it was made from (inputs, options, seed). Lines with another
// key are ignored. A line is written whole, unless the program dies while it writes; such an incomplete last
// line is ignored.
//
// Throws std::runtime_error naming the file where it cannot be written.
#ifndef LUXFIT_APPS_TEXT_TRIAL_LOG_H_
#define LUXFIT_APPS_TEXT_TRIAL_LOG_H_

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace luxfit {

class TrialLog {
 public:
  TrialLog(std::string path, std::string key);

  // Returns what an earlier call left for that trial; null where there is nothing.
  const nlohmann::json* Find(const std::string& trial) const;
  void Append(const std::string& trial, nlohmann::json result);
  size_t size() const { return lines_.size(); }

 private:
  std::string path_, key_;
  std::map<std::string, nlohmann::json> lines_;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_TRIAL_LOG_H_
