// Files that a session names: found beside it, or reported with the nearest name that is there.
//
// Throws std::runtime_error("FILE:LINE: key: expected an existing file, got ...; mend").
#ifndef LUXFIT_APPS_SESSION_SESSION_FILES_H_
#define LUXFIT_APPS_SESSION_SESSION_FILES_H_

#include <string>
#include <vector>

#include "apps/text/input_error.h"
#include "apps/text/toml_reader.h"

namespace luxfit {

// `name` relative to `folder` (or absolute), as the user would write it; checked to be a file.
std::string FindFile(const SourcePlace& place, const std::string& key, const std::string& folder,
                     const std::string& name);
std::string FindFile(const TomlCursor& value, const std::string& folder);

// The files that a pattern names (`*`, `?` and `[...]` as in a shell, in folders too), absolute, sorted; at
// least one.
std::vector<std::string> FindFiles(const TomlCursor& pattern, const std::string& folder);

std::string AbsolutePath(const std::string& path);

// The lower-case extension with its dot, "" for none.
std::string ExtensionOf(const std::string& name);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_FILES_H_
