// A folder of text files that lives as long as a test.
//
// Throws std::runtime_error where the system refuses it.
#ifndef LUXFIT_TESTS_SUPPORT_TEMP_FOLDER_H_
#define LUXFIT_TESTS_SUPPORT_TEMP_FOLDER_H_

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>

namespace luxfit {

class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "luxfit_test_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("TempFolder: expected a folder, got none");
    path_ = pattern;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string Path(const std::string& name) const { return (path_ / name).string(); }

  void Write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
  }

  std::string Read(const std::string& name) const {
    std::ifstream file(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // Replaces the first `from`, which must be there: a test that breaks nothing must not pass.
  void Replace(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = Read(name);
    const size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error("TempFolder: " + name + " does not hold: " + from);
    Write(name, text.replace(at, from.size(), to));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace luxfit

#endif  // LUXFIT_TESTS_SUPPORT_TEMP_FOLDER_H_
