// A session whose luminaires and reflectances are those of an earlier fit.
//
// What the result holds replaces what the session says; what the fit did not determine stays as the session
// has it, and is missing where that says nothing.
//
// Throws std::runtime_error naming the file where it is no result of luxfit, or one without fluxes in lm.
#ifndef LUXFIT_APPS_SESSION_EARLIER_RESULT_H_
#define LUXFIT_APPS_SESSION_EARLIER_RESULT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/session/session.h"

namespace luxfit {

// The same with luminaires alone, which no fit then changes; reflectances stay the session's.
Session WithLuminairesOf(Session session, const std::string& path);

// Fluxes of a fit without an absolute scale are relative: refused, or taken as they are.
enum class FluxUnit { kLumen, kAny };
Session WithResult(Session session, const std::string& path, FluxUnit unit = FluxUnit::kLumen);

// OUT/result.json. Throws where the file is something else.
nlohmann::json ReadResult(const std::string& path);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_EARLIER_RESULT_H_
