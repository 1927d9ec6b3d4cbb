// Calls functions with the object that a Python object holds. None, and an object made by __new__
// alone, hold none.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

namespace misalign::search::python {

/// Wraps a function or method for a binding; TypeError for None. pybind11 checks a holder
/// (RuntimeError), but would pass uninitialised memory as a reference.
template <class Answer, class Object, class... Arguments>
auto made(Answer (*function)(const Object&, Arguments...)) {
  return [function](const std::shared_ptr<Object>& object, Arguments... arguments) {
    if (!object) throw pybind11::type_error("None is not a sheet");
    return function(*object, std::forward<Arguments>(arguments)...);
  };
}
template <class Answer, class Object, class... Arguments>
auto made(Answer (Object::*method)(Arguments...) const) {
  return [method](const std::shared_ptr<Object>& object, Arguments... arguments) {
    if (!object) throw pybind11::type_error("None is not a catalogue");
    return ((*object).*method)(std::forward<Arguments>(arguments)...);
  };
}

}  // namespace misalign::search::python
