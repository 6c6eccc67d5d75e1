// The parts of the Python module `luxfit`: each defines the classes and functions of one noun.
//
// Numbers cross as numpy arrays (copies, float64 unless said), what has names as dicts and lists, in the keys
// of session files and result.json. Long calls let other Python threads run.
#ifndef LUXFIT_APPS_PYTHON_BINDINGS_H_
#define LUXFIT_APPS_PYTHON_BINDINGS_H_

#include <pybind11/pybind11.h>

namespace luxfit {

// InputError (a ValueError) for what is wrong in a file or an argument that a user wrote, MissingProgramError
// (a RuntimeError) for programs such as colmap that are not installed.
void BindErrors(pybind11::module_& module);
void BindLuminaire(pybind11::module_& module);
void BindRoom(pybind11::module_& module);
void BindSession(pybind11::module_& module);
void BindSimulation(pybind11::module_& module);
void BindResult(pybind11::module_& module);

}  // namespace luxfit

#endif  // LUXFIT_APPS_PYTHON_BINDINGS_H_
