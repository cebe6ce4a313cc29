// SPDX-License-Identifier: MIT
#include "diabolo/json/laws.hpp"

#include <pybind11/stl/filesystem.h>

#include <string>

#include "bindings.hpp"
#include "fields.hpp"

namespace diabolo::python {

namespace py = pybind11;

namespace {

using namespace py::literals;
using Laws = FormulaLaws<double>;

/// The text that their file would hold. Throws py::type_error where it could hold none.
std::string text_of(const py::object& laws) {
  const bool one = laws.is_none() || py::isinstance<py::str>(laws) || py::isinstance<py::dict>(laws);
  try {
    if (!one && py::isinstance<py::iterable>(laws))
      return py::module_::import("json")
          .attr("dumps")(py::list(laws), "allow_nan"_a = false)
          .cast<std::string>();
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError) &&
        !error.matches(PyExc_RecursionError))
      throw;
  }
  throw py::type_error("laws: " + shown_value(laws) +
                       "; expected FormulaLaws, or a list of laws that are made of texts and finite numbers");
}

/// By their text, so that both say the same of what is wrong.
Laws laws_from(const py::object& laws) {
  if (py::isinstance<Laws>(laws)) return laws.cast<Laws>();
  return read_laws(text_of(laws), "laws");
}

py::object list_of(const Laws& laws) {
  return py::module_::import("json").attr("loads")(to_json(laws).dump());
}

py::dict variables() {
  py::dict result;
  for (const LawVariable& variable : kLawVariables)
    result[py::str(std::string(variable.name))] =
        py::make_tuple(std::string(variable.unit), std::string(variable.meaning));
  return result;
}

}  // namespace

void bind_laws(py::module_& module) {
  py::class_<Laws> cls(module, "FormulaLaws", R"(Laws by formulas: somebody's own, or learnt by a diagnosis.

    FormulaLaws([{"name": "creep", "plain": "a string that creeps", "acts": "string", "formula": "rate * t",
                  "numbers": [{"name": "rate", "unit": "m/s", "usual": 0.001, "value": 0.002}]}])

What a formula gives [m/s^2] acts forward, left, up, against (the velocity), along (the string), across (its plane) or
lift (along omega x v); or it is the rate of the spin (spin, [rad/s^2]), a length added to the string (string, [m]) or
to the coefficient of its friction (friction).
It is made of its numbers, of `variables()`, of pi, + - * / ^ and of abs cos exp log max min sign sin sqrt tanh. The
first number is the amplitude: where it is zero there is nothing. A diagnosis needs `usual`, the usual size of a
number, and of the others `expected`, where it begins; `minimum` 0 says that a negative amplitude is against it.)");
  cls.def(py::init(&laws_from), "laws"_a = py::list());
  cls.def_static("load", &load_laws, "path"_a, Unlocked(), "Reads a file of the schema diabolo.laws/1.");
  cls.def_static("variables", &variables, "Name: (unit, meaning) of all that a formula may ask for.");
  cls.def("to_json", &write_laws, "The text of their file.");
  cls.def("to_list", &list_of, "The laws as the constructor takes them.");
  cls.def("__len__", [](const Laws& laws) { return laws.laws ? laws.laws->size() : 0; });
  cls.def("__repr__",
          [](const Laws& laws) { return "FormulaLaws(" + std::string(py::repr(list_of(laws))) + ")"; });
  cls.def(
      "__eq__",
      [](const Laws& a, const py::object& other) {
        return py::isinstance<Laws>(other) && list_of(a).equal(list_of(other.cast<const Laws&>()));
      },
      "other"_a);
  cls.def("__copy__", [](const Laws& laws) { return laws; });
  cls.def(
      "__deepcopy__", [](const Laws& laws, const py::dict&) { return laws; }, "memo"_a);
  cls.def(py::pickle([](const Laws& laws) { return write_laws(laws); },
                     [](const std::string& text) { return read_laws(text, "pickle"); }));
}

}  // namespace diabolo::python
