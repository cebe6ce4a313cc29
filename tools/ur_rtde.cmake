# SPDX-License-Identifier: MIT
# Read by ur_rtde's own build. One of its files holds a script of a thousand lines as one sum of strings, which GCC
# takes more than five minutes to optimise; it runs once per connection.
set_source_files_properties(src/script_client.cpp PROPERTIES COMPILE_OPTIONS -O0)
