# SPDX-License-Identifier: BSD-3-Clause
# Make judges sources by their times. A source that has changed since the last call of CMake and has
# an old time, as an upgrade may leave it, is touched.
file(GLOB_RECURSE all_sources *.f90 *.c)
foreach(source IN LISTS all_sources)
  file(SHA256 "${source}" digest)
  string(SHA1 known "${source}")
  if(DEFINED CACHE{${known}} AND NOT "$CACHE{${known}}" STREQUAL digest)
    file(TOUCH "${source}")
  endif()
  set(${known} "${digest}" CACHE INTERNAL "")
endforeach()
