// Takes the folders of one machine out of texts: a report is handed on, and its readers have other folders.
//
// A path below one of `folders` keeps what follows the folder; any other absolute path, which ends at a
// space or a quote, keeps its file name alone.
// Relative paths stay as they are.
#ifndef LUXFIT_APPS_REPORT_SHOWN_PATHS_H_
#define LUXFIT_APPS_REPORT_SHOWN_PATHS_H_

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace luxfit {

// `folders`: absolute paths without a '/' at their end.
std::string WithoutFolders(const std::string& text, const std::vector<std::string>& folders);

// Returns the deepest folder that holds all of the files, without a '/' at its end; empty where only the root does.
std::string CommonFolder(const std::vector<std::string>& files);

// Returns the same of every text and key of `data`, which holds no binary data as text.
nlohmann::json JsonWithoutFolders(const nlohmann::json& data, const std::vector<std::string>& folders);

}  // namespace luxfit

#endif  // LUXFIT_APPS_REPORT_SHOWN_PATHS_H_
