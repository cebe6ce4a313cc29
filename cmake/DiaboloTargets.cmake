# SPDX-License-Identifier: MIT
# Helpers for the project's own targets; nothing here reaches a program that uses the library.

# Warnings of our own code are errors; Eigen and other libraries come as system headers and stay quiet. GCC's note
# that it once passed SIMD vectors otherwise says nothing about a program compiled as a whole.
add_library(diabolo_warnings INTERFACE)
target_compile_options(diabolo_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>
  $<$<BOOL:${DIABOLO_WARNINGS_AS_ERRORS}>:-Werror>)

# Besides looking for faults, this build starts every Eigen matrix as NaN, so that a forgotten value shows.
add_library(diabolo_sanitizers INTERFACE)
if(DIABOLO_SANITIZE)
  target_compile_options(diabolo_sanitizers INTERFACE
    -fsanitize=${DIABOLO_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(diabolo_sanitizers INTERFACE -fsanitize=${DIABOLO_SANITIZE})
  target_compile_definitions(diabolo_sanitizers INTERFACE EIGEN_INITIALIZE_MATRICES_BY_NAN)
endif()

# Gives `target` the warnings, the sanitizers and the library, with JSON where it was found.
function(diabolo_configure_target target)
  target_link_libraries(${target} PRIVATE diabolo diabolo_warnings diabolo_sanitizers)
  if(TARGET diabolo_json)
    target_link_libraries(${target} PRIVATE diabolo_json)
  endif()
  if(TARGET diabolo_batch)
    target_link_libraries(${target} PRIVATE diabolo_batch)
  endif()
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
endfunction()

# Finds a package that an option asked for, or says how to do without it.
macro(diabolo_require package option debian)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR
      "${package} was not found: install it (Debian: ${debian}) or configure with -D${option}=OFF.")
  endif()
endmacro()
