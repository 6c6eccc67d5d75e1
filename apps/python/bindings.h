// Binds the parts of the Python module `luxfit`: each function defines the classes and functions of one noun.
//
// Numbers cross as numpy arrays (copies, float64 unless stated). Named values cross as dicts and lists, with
// the keys of session files and result.json. Long calls let other Python threads run.
#ifndef LUXFIT_APPS_PYTHON_BINDINGS_H_
#define LUXFIT_APPS_PYTHON_BINDINGS_H_

#include <pybind11/pybind11.h>

namespace luxfit {

// Defines InputError (a ValueError), for errors in a file or an argument that a user wrote, and
// MissingProgramError (a RuntimeError), for programs such as colmap that are not installed.
void BindErrors(pybind11::module_& module);
void BindLuminaire(pybind11::module_& module);
void BindRoom(pybind11::module_& module);
void BindSession(pybind11::module_& module);
void BindSimulation(pybind11::module_& module);
void BindResult(pybind11::module_& module);
void BindFit(pybind11::module_& module);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PYTHON_BINDINGS_H_
