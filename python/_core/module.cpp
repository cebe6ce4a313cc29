// SPDX-License-Identifier: MIT
#include <pybind11/pybind11.h>

#include <diabolo/version.hpp>

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled core of diabolo: the header-only C++ library, bound for Python.";
  module.attr("__version__") = diabolo::kVersion;
}
