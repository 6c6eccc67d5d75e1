#include <exception>
#include <stdexcept>
#include <utility>

#include "apps/python/bindings.h"
#include "apps/text/process.h"

namespace luxfit {
namespace {

namespace py = pybind11;

// Kept for the translator, which has no state. Never released, because statics end after the interpreter.
py::handle& InputErrorClass() {
  static py::handle instance;
  return instance;
}
py::handle& MissingProgramClass() {
  static py::handle instance;
  return instance;
}

void Translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const MissingProgram& e) {
    PyErr_SetString(MissingProgramClass().ptr(), e.what());
  } catch (const py::builtin_exception& e) {
    e.set_error();  // pybind11's own are runtime_errors too
  } catch (const std::runtime_error& e) {
    PyErr_SetString(InputErrorClass().ptr(), e.what());
  }
}

}  // namespace

void BindErrors(py::module_& module) {
  InputErrorClass() = PyErr_NewExceptionWithDoc(
      "luxfit.InputError", "An error in a file or argument: FILE:LINE: key: expected X, got Y; remedy.",
      PyExc_ValueError, nullptr);
  MissingProgramClass() = PyErr_NewExceptionWithDoc(
      "luxfit.MissingProgramError", "A program that is needed and not installed, with its Debian package.",
      PyExc_RuntimeError, nullptr);
  module.attr("InputError") = InputErrorClass();
  module.attr("MissingProgramError") = MissingProgramClass();
  py::register_local_exception_translator(Translate);
}

}  // namespace luxfit
