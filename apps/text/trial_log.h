// Lines of JSON that a long sweep appends as its trials end, so that a second call goes on where the first
// was stopped.
//
// Every line holds `key`, which says what it was made from (inputs, options, seed): lines of another key, and
// a last line that was cut off, count as not there. A line is written whole or, where the program dies in the
// middle, is such a last line.
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

  // What an earlier call left for that trial; null where there is nothing.
  const nlohmann::json* Find(const std::string& trial) const;
  void Append(const std::string& trial, nlohmann::json result);
  size_t size() const { return lines_.size(); }

 private:
  std::string path_, key_;
  std::map<std::string, nlohmann::json> lines_;
};

}  // namespace luxfit

#endif  // LUXFIT_APPS_TEXT_TRIAL_LOG_H_
