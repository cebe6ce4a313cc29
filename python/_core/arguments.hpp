// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

namespace diabolo::python {

/// What holds for the arguments of every function of the module; to be called once all are bound.
///
/// - A call whose arguments do not fit raises a TypeError of one sentence that names function, argument, what
/// was
///   found and what is expected (diabolo.argument_errors), not pybind11's list of signatures.
/// - The name of a file does for its recording.
/// - Masked values of a numpy.ma array become NaN, a dropout, where a Recording is made; elsewhere they are
/// refused.
/// - An object that its class's __new__ has made without __init__ raises a TypeError wherever it is used,
/// where
///   pybind11 hands out uninitialised memory.
void check_arguments(const pybind11::module_& module);

}  // namespace diabolo::python
