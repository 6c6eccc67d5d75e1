#include <pybind11/pybind11.h>

#include "apps/python/bindings.h"
#include "apps/version.h"

PYBIND11_MODULE(luxfit, module) {
  module.doc() =
      R"(Inverse-lighting calibration of rooms: photos -> luminaires and reflectances -> luxmeter check.

    session = luxfit.read_session("office/session.toml")     what is given
    result = luxfit.fit("office/session.toml", "out")        as `luxfit run`: writes out/result.json and returns it
    result = luxfit.read_result("out")                       the same of an earlier run
    light = luxfit.simulate(session.with_result("out"))      forward: illuminance per luminaire, patches
    room = luxfit.Room("room.obj")                           form factors and illuminance of one's own luminaires
    fit = luxfit.fit_room(room, states, photos=...)          a fit without a session file

World frame right-handed, z up, metres; fluxes lm, illuminance lx, exitance lm/m2, intensity cd. What the data do not
determine is NaN in arrays and None in dicts.)";
  module.attr("__version__") = luxfit::kVersion;
  luxfit::BindErrors(module);
  luxfit::BindLuminaire(module);
  luxfit::BindRoom(module);
  luxfit::BindSession(module);
  luxfit::BindSimulation(module);
  luxfit::BindResult(module);
  luxfit::BindFit(module);
}
