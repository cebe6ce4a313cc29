// SPDX-License-Identifier: MIT
#pragma once

/// One include for Catch2 version 3 and for version 2, which Debian 12 ships; `Approx` needs no namespace.

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
