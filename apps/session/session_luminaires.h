// The sections [states], [luminaires] and [[luminaire]] of a session.
//
// Throws std::runtime_error("FILE:LINE: key: ...") for dimmings outside 0..1, ids that two luminaires share,
// shapes whose size does not fit, sigmas without a value, and values that the format knows and this version
// cannot serve.
//
// Source: docs/session-format.md.
#ifndef LUXFIT_APPS_SESSION_SESSION_LUMINAIRES_H_
#define LUXFIT_APPS_SESSION_SESSION_LUMINAIRES_H_

#include <string>
#include <vector>

#include "apps/session/session.h"
#include "apps/text/toml_reader.h"

namespace luxfit {

// In file order, dimming of each luminaire named.
std::vector<SessionState> ReadStates(const TomlCursor& section);

// [[luminaire]] in file order, then those that only [states] names, in its order.
struct NamedLuminaires {
  std::vector<SessionLuminaire> luminaires;
  int count = 0;                    // of all there are, named or not
  bool count_is_estimated = false;  // there may be more
  int max = 12;                     // of those
};
// `session` is the whole document, `folder` where it lies.
NamedLuminaires ReadLuminaires(const TomlCursor& session, const std::string& folder);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_SESSION_LUMINAIRES_H_
