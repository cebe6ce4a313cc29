# SPDX-License-Identifier: MIT
# Fails when `object` defines a weak or unique symbol, by which its code could leak into the rest of a program.
execute_process(COMMAND "${nm}" --defined-only --extern-only --demangle "${object}"
                OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]* [VvWwu] [^\n]*" shared "${symbols}")
if(shared)
  list(JOIN shared "\n" shared)
  message(FATAL_ERROR "${object} defines symbols that are shared across object files:\n${shared}")
endif()
