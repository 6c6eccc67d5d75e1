// Reads the sections [groups], [luminaires] and [[luminaire]] of a session.
//
// Throws std::runtime_error("FILE:LINE: key: ...") for ids that two luminaires share, names in [groups] and
// [states] that nothing has, shapes whose size does not fit, sigmas without a value, and values of the format that this version does not
// support.
//
// Source: docs/session-format.md.
#ifndef LUXFIT_APPS_SESSION_SESSION_LUMINAIRES_H_
#define LUXFIT_APPS_SESSION_SESSION_LUMINAIRES_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/formats/toml_reader.h"

namespace luxfit {

// Holds the luminaires of [[luminaire]] in file order, followed by those that only [groups] or [states] name, in
// their order.
struct NamedLuminaires {
  std::vector<SessionGroup> groups;
  std::vector<SessionLuminaire> luminaires;
  int count = 0;                    // number of all luminaires, named or not
  bool count_is_estimated = false;  // there may be more
  int max = 0;                      // largest count; 0: not given
};
// `session` is the whole document, `folder` the folder that it lies in.
NamedLuminaires ReadLuminaires(const TomlCursor& session, const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_LUMINAIRES_H_
