// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "diabolo/recording/recording.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

/// A call as C gives it: positional arguments first, then those of the keywords `names` (a tuple, or null).
struct Call {
  PyObject* record;  ///< pybind11's of the function
  PyObject* const* values;
  Py_ssize_t positional;
  PyObject* names;
  Py_ssize_t size() const { return positional + (names ? PyTuple_GET_SIZE(names) : 0); }
};

using FastCall = PyObject* (*)(PyObject*, PyObject* const*, Py_ssize_t, PyObject*);
using PackedCall = PyObject* (*)(PyObject*, PyObject*, PyObject*);

/// pybind11's own entry, the same for all functions, in the form that its version has; and what each function
/// is called in a message. Written once, when the module is made.
struct Dispatch {
  FastCall fast = nullptr;
  PackedCall packed = nullptr;
  std::unordered_map<PyObject*, std::string> names;
};
Dispatch& dispatch() {
  static Dispatch* const one = new Dispatch;  // outlives the interpreter's last call
  return *one;
}

py::tuple positional_of(const Call& call) {
  py::tuple values(static_cast<std::size_t>(call.positional));
  for (Py_ssize_t i = 0; i < call.positional; ++i)
    values[static_cast<std::size_t>(i)] = py::reinterpret_borrow<py::object>(call.values[i]);
  return values;
}

py::dict keywords_of(const Call& call) {
  py::dict values;
  for (Py_ssize_t i = call.positional; i < call.size(); ++i)
    values[py::handle(PyTuple_GET_ITEM(call.names, i - call.positional))] = py::handle(call.values[i]);
  return values;
}

bool is_masked(PyObject* value) { return std::string_view(Py_TYPE(value)->tp_name).ends_with("MaskedArray"); }

template <class Go>
PyObject* checked(const Call& call, const Go& go);

/// Where pybind11 complains about arguments that do not fit: another call where a recording was given by the
/// name of its file, else a sentence in the place of the complaint.
template <class Go>
PyObject* explained(const Call& call, const Go& go) {
  if (!PyErr_ExceptionMatches(PyExc_TypeError)) return nullptr;
  py::error_already_set error;
  const std::string text = py::str(error.value());
  if (text.find("): incompatible ") == std::string::npos) {
    error.restore();
    return nullptr;
  }
  try {
    const py::module_ words = py::module_::import("diabolo.argument_errors");
    const py::tuple positional = positional_of(call);
    const py::dict keywords = keywords_of(call);
    const py::object loaded = words.attr("with_recordings")(text, positional, keywords);
    if (!loaded.is_none()) {
      std::vector<PyObject*> values;
      for (const py::handle value : py::reinterpret_borrow<py::list>(loaded)) values.push_back(value.ptr());
      return checked({call.record, values.data(), call.positional, call.names}, go);
    }
    const py::object sentence =
        words.attr("sentence")(dispatch().names[call.record], text, positional, keywords);
    PyErr_SetObject(PyExc_TypeError, sentence.ptr());
  } catch (py::error_already_set& other) {
    other.restore();
  }
  return nullptr;
}

/// Calls `go(values)` with masked arrays as plain ones.
template <class Go>
PyObject* unmasked(const Call& call, const Go& go) {
  try {
    const bool dropouts = call.positional > 0 && py::isinstance<Recording>(call.values[0]);
    const py::object plain = py::module_::import("diabolo.argument_errors").attr("plain_array");
    std::vector<py::object> kept;
    std::vector<PyObject*> values(call.values, call.values + call.size());
    for (PyObject*& value : values) {
      if (!is_masked(value)) continue;
      kept.push_back(plain(dispatch().names[call.record], py::handle(value), dropouts));
      value = kept.back().ptr();
    }
    return go(values.data());
  } catch (py::error_already_set& error) {
    error.restore();
    return nullptr;
  }
}

template <class Go>
PyObject* checked(const Call& call, const Go& go) {
  const bool masked = std::any_of(call.values, call.values + call.size(), &is_masked);
  PyObject* const result = masked ? unmasked(call, go) : go(call.values);
  return result ? result : explained(call, go);
}

PyObject* checked_fast(PyObject* record, PyObject* const* values, Py_ssize_t positional, PyObject* names) {
  const Call call{record, values, positional, names};
  return checked(call,
                 [&](PyObject* const* given) { return dispatch().fast(record, given, positional, names); });
}

/// The form of pybind11 before 3.1: a tuple and a dictionary.
PyObject* checked_packed(PyObject* record, PyObject* values, PyObject* keywords) {
  const py::tuple names(keywords ? py::dict(py::reinterpret_borrow<py::dict>(keywords)) : py::dict());
  std::vector<PyObject*> all;
  for (const py::handle value : py::reinterpret_borrow<py::tuple>(values)) all.push_back(value.ptr());
  const Py_ssize_t positional = static_cast<Py_ssize_t>(all.size());
  for (const py::handle name : names) all.push_back(PyDict_GetItem(keywords, name.ptr()));
  const Call call{record, all.data(), positional, names.ptr()};
  return checked(call, [&](PyObject* const* given) {
    const Call now{record, given, positional, names.ptr()};
    return dispatch().packed(record, positional_of(now).ptr(), keywords_of(now).ptr());
  });
}

/// Has a function, or the one in a method or a property, called by way of checked().
void check_function(py::handle function, const std::string& name) {
  if (PyInstanceMethod_Check(function.ptr()))
    return check_function(PyInstanceMethod_GET_FUNCTION(function.ptr()), name);
  if (py::isinstance<py::staticmethod>(function)) return check_function(function.attr("__func__"), name);
  if (py::isinstance(function, py::handle(reinterpret_cast<PyObject*>(&PyProperty_Type)))) {
    check_function(function.attr("fget"), name);
    return check_function(function.attr("fset"), name);
  }
  if (!PyCFunction_Check(function.ptr())) return;
  PyMethodDef& definition = *reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
  const auto replace = [&](auto& original, auto checked_call) {
    using Form = std::remove_reference_t<decltype(original)>;
    const auto given = reinterpret_cast<Form>(reinterpret_cast<void (*)()>(definition.ml_meth));
    if (given == checked_call) return;
    original = given;
    definition.ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(checked_call));
  };
  if (definition.ml_flags == (METH_FASTCALL | METH_KEYWORDS))
    replace(dispatch().fast, &checked_fast);
  else if (definition.ml_flags == (METH_VARARGS | METH_KEYWORDS))
    replace(dispatch().packed, &checked_packed);
  dispatch().names.emplace(PyCFunction_GET_SELF(function.ptr()), name);
}

/// Where pybind11 asks for the memory of a value that is not there yet, which it does for no other object.
void* refuse_to_allocate(std::size_t) {
  throw py::type_error("an object that __new__ alone has made; expected one whose __init__ has run");
}

void check_class(const py::type& type) {
  const std::string name = py::str(type.attr("__name__"));
  for (const auto& [key, attribute] :
       py::reinterpret_borrow<py::dict>(type.attr("__dict__").attr("copy")())) {
    const std::string own = py::str(key);
    check_function(attribute, own == "__init__" ? name : name + "." + own);
  }
  py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(type.ptr()))->operator_new = &refuse_to_allocate;
}

}  // namespace

void check_arguments(const py::module_& module) {
  const py::handle metaclass = reinterpret_cast<PyObject*>(py::detail::get_internals().default_metaclass);
  for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(module.attr("__dict__")))
    if (py::isinstance(value, metaclass))
      check_class(py::reinterpret_borrow<py::type>(value));
    else
      check_function(value, py::str(key));
}

}  // namespace diabolo::python
