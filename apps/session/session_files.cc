#include "apps/session/session_files.h"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "apps/text/suggest.h"

namespace luxfit {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> FileNamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());  // the file system's order differs between machines
  return names;
}

// Escapes a folder's name, so that no character is a wildcard.
std::string WithoutMagic(const std::string& name) {
  std::string escaped;
  for (const char c : name) {
    if (c == '*' || c == '?' || c == '[' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace

std::string FindFile(const SourcePlace& place, const std::string& key, const std::string& folder,
                     const std::string& name) {
  const fs::path path = (fs::path(folder) / name).lexically_normal();
  std::error_code error;
  if (fs::is_regular_file(path, error)) return path.string();
  const std::string expected = "expected an existing file, got " + Quoted(name);
  if (fs::is_directory(path, error)) throw InputError(place, key, expected + ", a folder; name a file in it");
  const std::string nearest = DidYouMean(path.filename().string(), FileNamesIn(path.parent_path()));
  throw InputError(place, key,
                   expected + " (there is no " + path.string() + ")" +
                       (nearest.empty() ? "; correct the name, or put the file there" : nearest));
}

std::string FindFile(const TomlCursor& value, const std::string& folder) {
  return FindFile(value.place(), value.key(), folder, value.Text("a file"));
}

std::vector<std::string> FindFiles(const TomlCursor& pattern, const std::string& folder) {
  const std::string text = pattern.Text("a file pattern such as \"board/*.png\"");
  const fs::path path = fs::path(text).is_absolute() ? fs::path(text) : fs::path(WithoutMagic(folder)) / text;
  glob_t found{};
  const int status = glob(path.c_str(), GLOB_NOSORT, nullptr, &found);
  std::vector<std::string> files;
  files.reserve(found.gl_pathc);
  std::error_code error;
  for (size_t i = 0; status == 0 && i < found.gl_pathc; ++i) {
    if (fs::is_regular_file(found.gl_pathv[i], error)) files.push_back(AbsolutePath(found.gl_pathv[i]));
  }
  globfree(&found);
  if (files.empty())
    throw pattern.Error("expected files that match, got none for " + Quoted(text) + " in " +
                        AbsolutePath(folder.empty() ? "." : folder) +
                        "; correct the pattern, or put the photos there");
  std::sort(files.begin(), files.end());  // glob's own order depends on the locale
  return files;
}

std::string AbsolutePath(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

std::string ExtensionOf(const std::string& name) { return Lowercase(fs::path(name).extension().string()); }

}  // namespace luxfit
