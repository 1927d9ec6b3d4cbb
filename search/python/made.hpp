// Calls with what an object holds. One that Python made by __new__ alone, and None, hold nothing.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <utility>

namespace misalign::search::python {

/// The function, or the method, as a binding calls it; TypeError for None. pybind11 checks a holder
/// before it gives it (RuntimeError), but lends memory that nothing was made in as a reference.
template <class Answer, class Object, class... Arguments>
auto made(Answer (*function)(const Object&, Arguments...)) {
  return [function](const std::shared_ptr<Object>& object, Arguments... arguments) {
    if (!object) throw pybind11::type_error("None is no sheet");
    return function(*object, std::forward<Arguments>(arguments)...);
  };
}
template <class Answer, class Object, class... Arguments>
auto made(Answer (Object::*method)(Arguments...) const) {
  return [method](const std::shared_ptr<Object>& object, Arguments... arguments) {
    if (!object) throw pybind11::type_error("None is no catalogue");
    return ((*object).*method)(std::forward<Arguments>(arguments)...);
  };
}

}  // namespace misalign::search::python
