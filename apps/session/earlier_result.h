// Replaces a session's luminaires and reflectances by those of an earlier fit.
//
// Values of the result replace those of the session. A value that the fit did not determine stays as the
// session has it, and is missing where the session does not give it.
//
// Throws std::runtime_error naming the file where it is no result of luxfit, or one without fluxes in lm.
#ifndef LUXFIT_APPS_SESSION_EARLIER_RESULT_H_
#define LUXFIT_APPS_SESSION_EARLIER_RESULT_H_

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/session/session.h"

namespace luxfit {

// Corrects the session as the run that wrote the result did (`--apply`).
Session WithCorrectionsOf(Session session, const nlohmann::json& result);

// Replaces the luminaires alone, which no fit then changes. Reflectances stay the session's.
Session WithLuminairesOf(Session session, const std::string& path);

// Does the above, too. Fluxes of a fit without an absolute scale are relative: kLumen refuses them, kAny takes them as they are. A flux that
// is not determined has no value in the result: kAsFitted takes where the fit ended, from stages/fit.json beside it.
enum class FluxUnit { kLumen, kAny, kAsFitted };
Session WithResult(Session session, const std::string& path, FluxUnit unit = FluxUnit::kLumen);

// Reads OUT/result.json. Throws where the file is something else.
nlohmann::json ReadResult(const std::string& path);

// An earlier result is named everywhere in one of two ways: the folder of its run, or the result.json in it.
// Return the file and the folder that such a name stands for; other names stay as they are.
std::string ResultFileOf(const std::string& named);
std::string RunFolderOf(const std::string& named);

}  // namespace luxfit

#endif  // LUXFIT_APPS_SESSION_EARLIER_RESULT_H_
