// SPDX-License-Identifier: MIT
#pragma once

/// Every operator new of this program so far; count_allocations.cpp counts.
extern long allocations;
