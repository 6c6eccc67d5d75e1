// Finds the files that a session names, beside it or by an absolute path.
//
// Throws std::runtime_error("FILE:LINE: key: expected an existing file, got ...; remedy"), with the nearest
// name that is there.
#ifndef LUXFIT_APPS_SESSION_SESSION_FILES_H_
#define LUXFIT_APPS_SESSION_SESSION_FILES_H_

#include <string>
#include <vector>

#include "apps/text/formats/toml_reader.h"
#include "apps/text/input_error.h"

namespace luxfit {

// Returns the path of an existing file. `name` is relative to `folder` or absolute, as the user writes it.
std::string FindFile(const SourcePlace& place, const std::string& key, const std::string& folder,
                     const std::string& name);
std::string FindFile(const TomlCursor& value, const std::string& folder);

// Returns the files that a pattern names (`*`, `?` and `[...]` as in a shell, in folders too), at least one.
// Paths are absolute and sorted.
std::vector<std::string> FindFiles(const TomlCursor& pattern, const std::string& folder);

std::string AbsolutePath(const std::string& path);

// Returns the lower-case extension with its dot, "" where there is none.
std::string ExtensionOf(const std::string& name);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_FILES_H_
